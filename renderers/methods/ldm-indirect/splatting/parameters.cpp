#include "renderers/methods/ldm-indirect/parameters.h"

namespace ir::methods::ldm_indirect {
namespace {

void add_ways(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::splatting,
             {.key = "splatting",
              .label = "Splatting",
              .doc = "How footprints are added up. The picture is the same but for rounding.",
              .citation = "Aalund15 §4.2",
              .choices =
                  {{"quads", "Quads",
                    "As published: photons are drawn as points, a geometry shader makes rectangles of "
                    "them, and blending adds."},
                   {"tiles", "Tiles",
                    "Compute shaders list the photons of each tile of 16 × 16 pixels in order, and "
                    "pixels add up their tile's. The host has a body for these alone."},
                   {"image-atomics", "Image atomics",
                    "A compute shader adds stored photons to pixels by atomic additions, whose order, "
                    "and rounding, differ from run to run."},
                   {"one-pass", "While tracing",
                    "The compute shader that traces photons through the maps adds them by atomic "
                    "additions, and stores none. As published it is slower; without a graphics card it may "
                    "take minutes. On the device alone. What looks at photons has them traced again."}},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate})
        .add(&Parameters::direct,
             {.key = "direct",
              .label = "Direct light",
              .doc = "What direct light comes from.",
              .citation = "Aalund15 §5.2",
              .choices = {{"rasterisation", "Shadow maps", "Sharp, with the materials' highlights."},
                          {"photons", "Photons",
                           "The photons' first hits, splatted as the others: blurred by the light's image, "
                           "diffuse, and part of indirect.irradiance. Footprints end at their pixels' "
                           "borders: single dots where splat_size is below 2."}},
              .on_change = OnChange::reallocate,
              .active_when = {"paths", {std::string("direct"), std::string("full")}}});
}

void add_footprints(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::environment_by,
             {.key = "environment_by",
              .label = "Direct light of the environment",
              .doc = "How it is found. What it lights is reflected further either way.",
              .citation = "Aalund15 fig. 11",
              .choices =
                  {{"samples", "Samples", "Rays, and the whole material: as in all methods of light."},
                   {"maps", "Maps",
                    "The maps' directions, each with the mean of the environment over its region. All "
                    "surfaces reflect it as Lambert's; shadows have as many edges as there are directions."}},
              .exact = {"samples"}})
        .add(&Parameters::splat_size,
             {.key = "splat_size",
              .label = "Splat size",
              .doc = "Scales the axes of all footprints: larger ones blur, smaller ones leave gaps.",
              .citation = "Aalund15 §5.2",
              .hard = {0.01, 100},
              .soft = {0.25, 4}})
        .add(&Parameters::topological_bias,
             {.key = "topological_bias",
              .label = "Topological bias",
              .doc = "How fast a footprint ends across its plane, a' in a = a' √|D_u x × D_v x|: at 1 it "
                     "reaches as far as the geometric mean of its semi-axes, at 2 half as far. Small values "
                     "light surfaces behind and before the receiver, large ones darken those that bend away.",
              .citation = "Aalund15 eq. 7",
              .hard = {0.02, 100},
              .soft = {0.25, 4}})
        .add(&Parameters::min_axis_pixels,
             {.key = "min_axis_pixels",
              .label = "Minimum semi-axis",
              .doc = "Shorter semi-axes are made so long, and the photon fainter: footprints that fall "
                     "between the pixels' middles would be lost.",
              .unit = "pixels",
              .hard = {0, 64},
              .soft = {0, 4}})
        .add(&Parameters::max_axis,
             {.key = "max_axis",
              .label = "Maximum semi-axis",
              .doc = "Longer semi-axes, as of light that grazes its receiver or of few directions, are cut "
                     "to this fraction of the radius of the scene's bounds, and the photon is as much "
                     "brighter; splat.long counts them.",
              .unit = "radii",
              .hard = {1e-4, 10},
              .soft = {0.01, 1}});
}

}  // namespace

void add_splatting_parameters(ParameterTable<Parameters>& table) {
    add_ways(table);
    add_footprints(table);
}

}  // namespace ir::methods::ldm_indirect
