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

graph::ImageRef declare_winning(graph::GraphBuilder& builder, VisibleSplats& visible,
                                const std::string& fingerprint) {
    const int samples = visible.splats.samples;
    const auto declare = [&](const std::string& key, gl::Format format) {
        return builder.output(key, {.format = format, .layers = samples, .fingerprint = fingerprint});
    };
    visible.nearest = declare("splats.nearest", gl::Format::r32ui);
    visible.hit_level = declare("splats.hit_level", gl::Format::r16f);
    return passes::bounce::declare_distance(builder, samples, fingerprint);
}

graph::ImageRef combine_levels(graph::GraphBuilder& builder, VisibleSplats& visible) {
    const int samples = visible.splats.samples;
    const auto distance = declare_winning(builder, visible);
    auto pass = builder.pass("combine levels");
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("places", visible.splats.hierarchy.places)
        .reads("winners", visible.winner)
        .reads("depths", visible.depth)
        .reads(visible.gbuffer.position)
        .reads("directions", visible.directions.directions);
    if (visible.exact.index >= 0) pass.reads("exact_rays", visible.exact);
    pass.writes("distance_image", distance)
        .writes("nearest_image", visible.nearest)
        .writes("level_image", visible.hit_level);
    passes::bounce::compute_by_tiles(
        pass, builder, with_acceptance({{folder + "combine.comp"}}, visible.splats),
        Combine{visible.splats.hierarchy.levels, samples, nearest_decides(visible.splats)});
    return distance;
}

}  // namespace ir::methods::deep_screen_space
