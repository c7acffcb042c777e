#include "renderers/methods/ldm-indirect/stages.h"

#include "renderers/passes/direct/direct_light.h"

namespace ir::methods::ldm_indirect {
namespace {

std::vector<OutputDescription> pictures() {
    std::vector<OutputDescription> all{
        {.key = "radiance",
         .label = "Radiance",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc = "Towards the eye: emission, direct light and indirect light, as the paths say."},
        {.key = "indirect.irradiance",
         .label = "Splatted irradiance",
         .semantic = Semantic::irradiance,
         .unit = "W/m²",
         .doc = "Sum of the photons' footprints at the pixel; with direct light where photons carry it. "
                "A: how many photons add to the pixel."},
        {.key = "indirect.direction",
         .label = "Sum of directions",
         .unit = "W/m²",
         .doc =
             "Directions to where the splatted light comes from, each as long as the sum of red, green and "
             "blue of what comes from there."},
        {.key = "indirect.radiance",
         .label = "Indirect radiance",
         .semantic = Semantic::radiance,
         .unit = "W/(m² sr)",
         .doc =
             "What the pixel's surface reflects: ρ/π of the splatted irradiance, and its highlights as `gloss` or "
             "`receiver` says."},
        passes::valid_output()};
    auto direct = passes::direct_outputs();
    direct.front().active_when = {"direct", {std::string("rasterisation")}};
    all.insert(all.end(), direct.begin(), direct.end());
    return all;
}

std::vector<OutputDescription> explanations() {
    return {
        {.key = "indirect.explain.photons",
         .label = "Photons that light the pixel",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "Footprints, as splatted, that cover the picked pixel's point, the largest contribution "
                "first. contribution: RGB, W/m², to the splatted irradiance. flux: W. map, side: what "
                "direction it came along; directly from the light, the map is 65535. source: texel of the "
                "lights' images. path_length: m, from the light. distance: m, from the pixel's point to the "
                "footprint's middle. photon: its place in the photon buffer.",
         .categories = {side_categories()},
         .when_empty = no_surface,
         .explains = true},
        {.key = "indirect.explain.sum",
         .label = "Sum of the photons against the pixel",
         .kind = OutputKind::table,
         .unit = "W/m²",
         .doc = "gathered: the sum of what the photons above contribute, found by a search through the "
                "whole photon buffer, by eq. 7 as printed; direct: the part that came directly from the "
                "lights; pixel: the splatted irradiance; difference: pixel less gathered, which is "
                "rounding.",
         .when_empty = no_surface,
         .explains = true},
        {.key = "indirect.explain.directions",
         .label = "Light by direction",
         .kind = OutputKind::sphere_values,
         .unit = "W/m²",
         .doc = "What each of the 2N directions adds to the picked pixel. centre: where its light comes "
                "from. contribution: RGB, W/m²; luminance: the same as one number; photons: how many. "
                "map, side: as of the photons; light that comes directly is not in it.",
         .categories = {side_categories()},
         .when_empty = no_surface,
         .explains = true},
        {.key = "indirect.explain.paths",
         .label = "Paths of the photons",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "Photons that came directly have the first leg alone. The point in between follows from "
                "length and direction. contribution, map, side and photon as of the photons.",
         .categories = {{"leg",
                         {{0, "from the light to where a photon was split", tints::yellow},
                          {1, "from there to its footprint", tints::sky}}},
                        side_categories()},
         .when_empty = no_surface,
         .explains = true}};
}

}  // namespace

std::vector<OutputDescription> splatting_outputs() {
    return joined({pictures(), explanations()});
}

}  // namespace ir::methods::ldm_indirect
