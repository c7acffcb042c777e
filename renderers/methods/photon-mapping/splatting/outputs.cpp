#include "renderers/methods/photon-mapping/bounces.h"
#include "renderers/methods/photon-mapping/stages.h"

namespace ir::methods::photon_mapping {

std::vector<OutputDescription> splatting_outputs() {
    return {
        {.key = "splat.irradiance",
         .label = "Unfiltered irradiance",
         .semantic = Semantic::irradiance,
         .unit = "W/m²",
         .doc =
             "Sum of all kernels over the texel, at the splatting resolution. A: x of the sum of directions "
             "to the light, each weighted by R + G + B of what it adds. With the receivers “full” the "
             "irradiance of the surface as it is shaded, without what its interface reflects; A: red of "
             "that, W/(m² sr), over the interface's albedo."},
        {.key = "splat.direction",
         .label = "Direction of the light, y and z",
         .doc = "y and z of the sum of directions whose x stands in the irradiance, world space. With the "
                "receivers “full” green and blue of what the interface reflects."},
        {.key = "splat.depth",
         .label = "Depth at the splatting resolution",
         .semantic = Semantic::depth,
         .unit = "m",
         .doc = "Distance along the view axis of the pixel that the texel is for; infinite: background."},
        {.key = "splat.tiles",
         .label = "Photons by tile",
         .semantic = Semantic::count,
         .doc = "Photons within each tile of the picture that face the viewer, hidden ones too: what the "
                "kernels' size comes from."},
        {.key = "splat.count",
         .label = "Kernels per texel",
         .semantic = Semantic::count,
         .doc = "How many photons add to the texel."},
        {.key = "photons.overlay",
         .label = "Photons over the picture",
         .semantic = Semantic::albedo,
         .doc = "A dot for each photon that is seen, over the scene in grey, in the colour of its bounce.",
         .categories = {bounce_categories("")}},
        {.key = "splat.kernels",
         .label = "Kernels",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "The kernels of all photons that face the viewer, as large as they are splatted. irradiance: "
                "RGB, W/m², where it covers. radius: of the kernel across the light, m. bounce and light: as "
                "of photon locations. photon: its place in the photon buffer. lights_pixel: whether it "
                "covers the picked pixel's texel.",
         .categories = {bounce_categories("bounce"),
                        {"lights_pixel",
                         {{0, "others", tints::sky},
                          {1, "those that light the picked pixel", tints::orange}}}},
         .explains = true},
        {.key = "splat.explain.photons",
         .label = "Photons that light the pixel",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "The kernels that cover the picked pixel's texel, the largest contribution first. "
             "contribution: RGB, W/m², to the unfiltered irradiance. power: W. distance: from the surface "
             "to the photon, m. radius: of the kernel across the light, m. light: as of photon locations. "
             "photon: its place in the photon buffer. path: its place in this list, by which the paths name it.",
         .categories = {bounce_categories("bounce")},
         .when_empty = "no kernel covers the texel in this frame: the light there comes from neighbours and "
                       "earlier frames, by filtering",
         .explains = true},
        {.key = "splat.explain.sum",
         .label = "Sum of the photons against the pixel",
         .kind = OutputKind::table,
         .unit = "W/m²",
         .doc = "gathered: the sum of what the photons above contribute, found by a search through the whole "
                "photon buffer; pixel: the texel's unfiltered irradiance; difference: pixel less gathered, "
                "which is rounding: some millionths of it in single precision, up to a half thousandth for "
                "each kernel in half precision. Empty while no pixel is picked.",
         .explains = true},
    };
}

}  // namespace ir::methods::photon_mapping
