#include "renderers/passes/ldm/parameters.h"

namespace ir::passes::ldm {
namespace {

const Condition tangent_plane{"self_hit", {std::string("tangent-plane")}};
const Condition normal_offset{"self_hit", {std::string("normal-offset")}};

std::vector<Choice> storages(const MapChoices& choices) {
    std::vector<Choice> result{
        {"linked-lists", "Linked lists",
         "Pre-sorted per-pixel singly linked lists, as published: 8 bytes per fragment.", Effect::cost},
        {"arrays", "Arrays",
         "Contiguous sorted arrays (count, prefix sum, scatter, sort): 2 bytes per fragment. The "
         "default: smaller and, measured on a software rasteriser, faster than lists.",
         choices.sloped ? Effect::image : Effect::cost},  // nodes with slopes give another picture
        {"sparse-arrays", "Sparsity-aware arrays",
         "Contiguous sorted arrays whose offsets are kept, and summed, for texels with fragments "
         "alone (S-buffer).",
         Effect::cost},
        {"packed-arrays", "Packed arrays",
         "Contiguous sorted arrays of 11-bit depths and one byte of offsets per texel: the least memory, 1.5 "
         "bytes per fragment on Sponza. Depths are rounded to 32 quanta (1/2044 of the scene), so that hits "
         "move by up to 16; entries equal after that are one; self-hit tolerances are at least 17 quanta."},
        {"lists-then-sort", "Linked lists, sorted after",
         "Per-pixel singly linked lists in order of arrival, and a pass that sorts them.", Effect::cost},
        {"pages", "Linked pages",
         "Paged per-pixel singly linked lists: several depths per node, sorted after.", Effect::cost},
        {"fixed-arrays", "Fixed arrays, sorted after",
         "A fixed number of layers per texel; those that arrive after it is full are dropped and "
         "counted. Which ones arrive late may differ from run to run."},
        {"fixed-arrays-presorted", "Fixed arrays, pre-sorted",
         "A fixed number of layers per texel, sorted while they arrive: the nearest ones along the "
         "map's direction stay, the others are dropped and counted."},
        {"hash", "Hash table",
         "One table for all texels, entries found by hashing texel and age (HA-buffer).", Effect::cost},
        {"depth-peeling", "Depth peeling",
         "Layer by layer, each the nearest beyond the one before: slow and exact, what the others "
         "are tested against.",
         Effect::cost}};
    if (choices.outermost)
        result.push_back({"outermost", "Outermost depths",
                          "The first and the last depth of a texel, without lists: 4 bytes per texel. They "
                          "answer hits at any distance by the rule tangent-plane as lists do; for anything "
                          "else arrays are used, and a note says so. Views of maps show two layers.",
                          Effect::cost});
    return result;
}

void add_maps(ParameterTable<MapParameters>& table, const MapChoices& choices) {
    table
        .add(
            &MapParameters::directions,
            {.key = "directions",
             .label = "Directions",
             .doc = "Number N of maps. Each serves a direction and its opposite, so that 2N directions cover "
                    "the sphere.",
             .citation = "Aalund15 §3.2",
             .hard = {1, 4096},
             .soft = {16, 1024},
             .on_change = OnChange::reallocate,
             .coarse = std::int64_t{16}})
        .add(&MapParameters::resolution, {.key = "resolution",
                                          .label = "Resolution",
                                          .doc = "Texels along each side of a map.",
                                          .unit = "texels",
                                          .citation = "Aalund15 §5.1",
                                          .hard = {1, 2048},
                                          .soft = {50, 600},
                                          .on_change = OnChange::reallocate})
        .add(
            &MapParameters::detail,
            {.key = "detail",
             .label = "Detail",
             .doc = "Part of the scene's triangles that maps are built of. Below 1 the scene is simplified "
                    "first, as far as its topology allows; what has an alpha mask stays. Points still lie on "
                    "the scene's own surfaces, which then hit or miss those of the maps nearby. A scene of "
                    "few large triangles loses its walls.",
             .citation = "Tokuyoshi12",
             .hard = {0, 1},
             .soft = {0.05, 1},
             .on_change = OnChange::reallocate})
        .add(&MapParameters::storage, {.key = "storage",
                                       .label = "Storage",
                                       .doc = "How a map keeps the sorted depths of its texels.",
                                       .citation = "Aalund15 §2.1",
                                       .choices = storages(choices),
                                       .on_change = OnChange::reallocate})
        .add(&MapParameters::fixed_layers,
             {.key = "fixed_layers",
              .label = "Fixed layers",
              .doc = "Layers that each texel has room for. What does not fit is dropped, counted in "
                     "ldm.dropped, and missing from the picture.",
              .citation = "Aalund15 §2.1",
              .hard = {1, 256},
              .soft = {4, 64},
              .on_change = OnChange::reallocate,
              .active_when = {"storage",
                              {std::string("fixed-arrays"), std::string("fixed-arrays-presorted")}}})
        .add(&MapParameters::builder,
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

void add_self_hits(ParameterTable<MapParameters>& table) {
    table
        .add(&MapParameters::self_hit,
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
            &MapParameters::self_hit_tolerance,
            {.key = "self_hit_tolerance",
             .label = "Depth tolerance",
             .doc = "Entries within this many quanta of the tangent plane are the point's own. A map's depth "
                    "range has 65,408 quanta.",
             .unit = "quanta",
             .hard = {0, 32768},
             .soft = {0, 200},
             .active_when = tangent_plane})
        .add(&MapParameters::slope_tolerance,
             {.key = "slope_tolerance",
              .label = "Slope tolerance",
              .doc =
                  "Added to the tolerance: the depth that the tangent plane gains over this many texels. It "
                  "covers curved surfaces.",
              .unit = "texels",
              .hard = {0, 16},
              .soft = {0, 2},
              .active_when = tangent_plane})
        .add(&MapParameters::max_dip, {.key = "max_dip",
                                       .label = "Maximum dip",
                                       .doc = "A ray through the texel's centre may run below the point's "
                                              "surface for this much depth; beyond it, the centre on the "
                                              "point's other side is queried. Up to 1, closed walls of two "
                                              "texels do not leak.",
                                       .unit = "texels",
                                       .hard = {0, 64},
                                       .soft = {0, 4},
                                       .active_when = tangent_plane})
        .add(&MapParameters::normal_offset,
             {.key = "normal_offset",
              .label = "Normal offset",
              .doc = "How far points move along their normal for the normal-offset rule.",
              .unit = "texels",
              .hard = {0, 64},
              .soft = {0, 4},
              .active_when = normal_offset});
}

}  // namespace

ParameterTable<MapParameters> map_parameters(const MapChoices& choices) {
    ParameterTable<MapParameters> table;
    add_maps(table, choices);
    return table;
}

Condition keeps_slopes() {
    Condition condition{"storage", {}};
    const auto kinds = storages({.outermost = true});
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        if (may_keep_slopes(static_cast<StorageKind>(kind))) condition.values.push_back(kinds[kind].key);
    return condition;
}

ParameterTable<MapParameters> self_hit_parameters() {
    ParameterTable<MapParameters> table;
    add_self_hits(table);
    return table;
}

}  // namespace ir::passes::ldm
