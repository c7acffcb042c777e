#include "renderers/passes/ldm/walk.h"

#include "renderers/core/record.h"
#include "shaders/passes/ldm/walk.glsl.h"

namespace ir::passes::ldm {
namespace {

/// Entries that are reserved for each map, and lines of the walk.
constexpr std::uint64_t expected_entries = 64;

const Categories what_an_entry_is{"role",
                                  {{0, "none", tints::grey},
                                   {1, "the point's own", tints::green},
                                   {2, "hit along the direction", tints::orange},
                                   {3, "hit against it", tints::sky},
                                   {4, "passed over by its slopes", tints::purple}}};

}  // namespace

Categories what_was_hit() {
    return {"hit",
            {{-1, "below the surface, not queried", tints::dark},
             {0, "miss", tints::sky},
             {1, "hit", tints::orange}}};
}

Categories yes_or_no(const std::string& field, const std::string& no, const std::string& yes) {
    return {field, {{0, no, tints::grey}, {1, yes, tints::green}}};
}

void WalkViews::written_by(graph::PassBuilder& pass) const {
    pass.writes("Entries", entries.elements)
        .writes("Walk", walk.elements)
        .writes("Texels", texel.elements)
        .writes("Nodes", nodes.elements)
        .counts("EntryCount", entries.count)
        .counts("WalkCount", walk.count)
        .counts("TexelCount", texel.count)
        .counts("NodeCount", nodes.count);
}

std::vector<OutputDescription> walk_outputs(const WalkText& text) {
    return {
        {.key = "ldm.explain.entries",
         .label = "Entries of the texel",
         .kind = OutputKind::point_set,
         .semantic = Semantic::position,
         .unit = "m",
         .doc = "All depths at the texel where " + text.map + " is queried for " + text.point +
                ". depth: metres along the map's direction, from the point. layer: 0 is the first along that "
                "direction.",
         .categories = {what_an_entry_is},
         .when_empty = text.when_empty,
         .explains = true},
        {.key = "ldm.explain.walk",
         .label = "Walk through the map",
         .kind = OutputKind::line_set,
         .unit = "m",
         .doc = "From " + text.point + " along and against the direction of " + text.map +
                " to what is found there, or to " + text.ends +
                "; hit says which. above: whether the direction is above the surface, and counts. Then from "
                "entry to entry of the texel, up to the one where a search from the front ends; step counts "
                "them.",
         .categories = {{"role",
                         {{0, "along the direction", tints::orange},
                          {1, "against it", tints::sky},
                          {2, "from entry to entry", tints::purple}}},
                        what_was_hit(),
                        yes_or_no("above", "below the surface", "above, counts")},
         .when_empty = text.when_empty,
         .explains = true},
        {.key = "ldm.explain.texel",
         .label = "Queried texel",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc = "The outline of the texel where " + text.map +
                " is queried, as high as the point's surface at its middle.",
         .when_empty = text.when_empty,
         .explains = true},
        {.key = "ldm.explain.nodes",
         .label = "Surfaces of nodes",
         .kind = OutputKind::glyphs,
         .unit = "m",
         .doc =
             "Of each entry of the texel its outline, tilted as the node's slopes say that its "
             "surface lies, but not steeper than 4 texels of depth a texel. slope_u, slope_v: depth gained along "
             "the texel's sides, in m per m. Nodes without slopes lie flat.",
         .categories = {what_an_entry_is},
         .when_empty = text.when_empty,
         .explains = true},
    };
}

WalkViews declare_walk_views(graph::GraphBuilder& builder, std::uint64_t maps) {
    const auto declare = [&](const std::string& output, std::vector<graph::Field> fields,
                             std::uint64_t elements, const std::string& counter, const std::string& label) {
        return builder.explanation("ldm.explain." + output,
                                   {.fields = std::move(fields), .elements = elements},
                                   {.key = "ldm.explain." + counter, .label = label});
    };
    return {.entries = declare("entries", record_fields<Entry>(), maps * expected_entries, "entry_count",
                               "Entries of the texel"),
            .walk = declare("walk", record_fields<WalkLine>(), maps * expected_entries, "walk_count",
                            "Lines of the walk"),
            .texel = declare("texel", record_fields<Texel>(), maps, "texel_count", "Texels queried"),
            .nodes = declare("nodes", record_fields<NodeOutline>(), maps * expected_entries, "node_count",
                             "Nodes of the texel")};
}

}  // namespace ir::passes::ldm
