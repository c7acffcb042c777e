#include "renderers/methods/ldm-ao/parameters.h"

namespace ir::methods::ldm_ao {
namespace {

const Condition tangent_plane{"self_hit", {std::string("tangent-plane")}};
const Condition normal_offset{"self_hit", {std::string("normal-offset")}};

void add_maps(ParameterTable<Parameters>& table) {
    table
        .add(
            &Parameters::directions,
            {.key = "directions",
             .label = "Directions",
             .doc = "Number N of maps. Each serves a direction and its opposite, so that 2N directions cover "
                    "the sphere.",
             .citation = "Aalund15 §3.2",
             .hard = {1, 4096},
             .soft = {16, 1024},
             .on_change = OnChange::reallocate})
        .add(&Parameters::resolution, {.key = "resolution",
                                       .label = "Resolution",
                                       .doc = "Texels along each side of a map.",
                                       .unit = "texels",
                                       .citation = "Aalund15 §5.1",
                                       .hard = {1, 2048},
                                       .soft = {50, 600},
                                       .on_change = OnChange::reallocate})
        .add(&Parameters::storage,
             {.key = "storage",
              .label = "Storage",
              .doc = "How a map keeps the sorted depths of its texels.",
              .citation = "Aalund15 §2.1",
              .choices = {{"linked-lists", "Linked lists",
                           "Pre-sorted per-pixel singly linked lists, as published: 8 bytes per fragment."},
                          {"arrays", "Arrays",
                           "Contiguous sorted arrays: 2 bytes per fragment. The default: the smaller and, "
                           "measured on a "
                           "software rasteriser, the faster one."}},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate})
        .add(&Parameters::builder,
             {.key = "builder",
              .label = "Builder",
              .doc = "What turns triangles into fragments.",
              .choices =
                  {{"raster", "Rasteriser", "OpenGL's rasteriser with a fragment shader, as published."},
                   {"compute", "Compute",
                    "A rasteriser in compute shaders. The default: measured on a software rasteriser, it "
                    "builds about three times as fast."}},
              .effect = Effect::cost,
              .on_change = OnChange::reallocate});
}

void add_self_hits(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::self_hit,
             {.key = "self_hit",
              .label = "Self-hit rule",
              .doc = "How a point's own surface is told from what occludes it.",
              .citation = "Aalund15 §3.1",
              .choices =
                  {{"tangent-plane", "Tangent plane",
                    "The point's tangent plane says where its own entry lies at the texel's centre; the "
                    "first entry beyond a tolerance is the hit."},
                   {"normal-offset", "Normal offset",
                    "The point is moved along its normal by offset · sin∠(n, v); the nearest entry is "
                    "taken for its own, the next one is the hit."}}})
        .add(
            &Parameters::self_hit_tolerance,
            {.key = "self_hit_tolerance",
             .label = "Depth tolerance",
             .doc = "Entries within this many quanta of the tangent plane are the point's own. A map's depth "
                    "range has 65,408 quanta.",
             .unit = "quanta",
             .hard = {0, 32768},
             .soft = {0, 200},
             .active_when = tangent_plane})
        .add(&Parameters::slope_tolerance,
             {.key = "slope_tolerance",
              .label = "Slope tolerance",
              .doc =
                  "Added to the tolerance: the depth that the tangent plane gains over this many texels. It "
                  "covers curved surfaces.",
              .unit = "texels",
              .hard = {0, 16},
              .soft = {0, 2},
              .active_when = tangent_plane})
        .add(&Parameters::largest_dip, {.key = "largest_dip",
                                        .label = "Largest dip",
                                        .doc = "A ray through the texel's centre may run below the point's "
                                               "surface for this much depth; beyond "
                                               "it, the centre on the point's other side is asked. Up to 1, "
                                               "closed walls of two texels do not "
                                               "leak.",
                                        .unit = "texels",
                                        .hard = {0, 64},
                                        .soft = {0, 4},
                                        .active_when = tangent_plane})
        .add(&Parameters::normal_offset,
             {.key = "normal_offset",
              .label = "Normal offset",
              .doc = "How far points move along their normal for the normal-offset rule.",
              .unit = "texels",
              .hard = {0, 64},
              .soft = {0, 4},
              .active_when = normal_offset});
}

void add_exact(ParameterTable<Parameters>& table) {
    table
        .add(&Parameters::exact,
             {.key = "exact",
              .label = "Exact rays",
              .doc =
                  "Takes hits from ray tracing instead of the maps, to tell the causes of error apart: what "
                  "is left with all hits exact is due to the directions, what exact hits nearby take away "
                  "to the self-hit rule, and the rest to the texels.",
              .choices = {{"none", "None", "All hits come from the maps: the method itself."},
                          {"near", "Near hits",
                           "Hits up to a few texels away are exact, those beyond come "
                           "from the maps."},
                          {"all", "All hits", "The maps are not asked."}}})
        .add(&Parameters::exact_texels,
             {.key = "exact_texels",
              .label = "Reach of exact rays",
              .doc = "Hits up to so far away are exact, in texels of the map asked.",
              .unit = "texels",
              .hard = {0, 4096},
              .soft = {0, 16},
              .active_when = {"exact", {std::string("near")}}});
}

}  // namespace

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    add_maps(table);
    table.include(
        &Parameters::transport,
        transport_parameters({.paths = {"ao"}, .keys = {"max_distance", "falloff", "normal_maps"}}));
    add_self_hits(table);
    add_exact(table);
    table
        .add(&Parameters::progressive,
             {.key = "progressive",
              .label = "Progressive",
              .doc = "Turns the set of directions at random in every frame and averages over frames. Turning "
                     "adds noise; without it frames are equal.",
              .citation = "Aalund15 §6"})
        .add(&Parameters::ambient,
             {.key = "ambient",
              .label = "Ambient radiance",
              .doc = "Radiance from all directions that accessibility attenuates, in the "
                     "output “lit”.",
              .unit = "W/(m² sr)",
              .hard = {0, 1e6},
              .soft = {0, 2}});
    return table;
}

}  // namespace ir::methods::ldm_ao
