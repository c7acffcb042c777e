#pragma once

#include "renderers/core/output.h"
#include "renderers/graph/builder.h"

namespace ir::passes::ldm {

/// What shaders/passes/ldm/walk.glsl writes. Empty while nobody looks.
struct WalkViews {
    graph::CountedBuffer entries;  ///< "ldm.explain.entries": the sequence at the texel that is queried
    graph::CountedBuffer walk;     ///< "ldm.explain.walk": what was found from there, and the way there
    graph::CountedBuffer texel;    ///< "ldm.explain.texel": its outline
    graph::CountedBuffer nodes;    ///< "ldm.explain.nodes": outlines that lie as its nodes' surfaces do
    void written_by(graph::PassBuilder& pass) const;
};

/// Whether a ray hits something: field `hit` of explanations.
Categories what_was_hit();
/// Of a field that is 0 or 1.
Categories yes_or_no(const std::string& field, const std::string& no, const std::string& yes);

/// What is walked from, and through which map, for the texts of the views.
struct WalkText {
    std::string point;       ///< "the pixel's point"
    std::string map;         ///< "the map chosen"
    std::string ends;        ///< where rays that hit nothing end
    std::string when_empty;  ///< as OutputDescription has it
};
std::vector<OutputDescription> walk_outputs(const WalkText& text);

/// For walks through so many maps.
WalkViews declare_walk_views(graph::GraphBuilder& builder, std::uint64_t maps);

}  // namespace ir::passes::ldm
