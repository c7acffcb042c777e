#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of combine.comp.
struct Combine {
    int levels, samples;
    bool nearest_decides;
    IR_FIELDS(levels, samples, nearest_decides)
};

}  // namespace

void combine_levels(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    auto pass = builder.pass("combine levels" + batch);
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("places", visible.splats.hierarchy.places)
        .reads("winners", visible.winner)
        .reads("depths", visible.depth)
        .reads(visible.gbuffer.position)
        .reads("directions", visible.directions.directions);
    if (visible.exact.index >= 0) pass.reads("exact_rays", visible.exact);
    pass.writes("distance_image", visible.samples.distance)
        .writes("nearest_image", visible.nearest)
        .writes("level_image", visible.hit_level);
    passes::bounce::compute_by_tiles(
        pass, builder, with_acceptance({{folder + "combine.comp"}}, visible.splats),
        Combine{visible.splats.hierarchy.levels, visible.splats.samples, nearest_decides(visible.splats)});
}

}  // namespace ir::methods::deep_screen_space
