#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

graph::ImageRef declare_of_samples(graph::GraphBuilder& builder, const std::string& key, gl::Format format,
                                   int samples) {
    return builder.output(key, {.format = format, .layers = samples});
}

/// Constants of combine.comp.
struct Combine {
    int levels, samples;
    bool nearest_decides;
    IR_FIELDS(levels, samples, nearest_decides)
};

}  // namespace

graph::ImageRef combine_levels(graph::GraphBuilder& builder, VisibleSplats& visible) {
    const int samples = visible.splats.samples;
    const auto distance = passes::bounce::declare_distance(builder, samples);
    visible.nearest = declare_of_samples(builder, "splats.nearest", gl::Format::r32ui, samples);
    visible.hit_level = declare_of_samples(builder, "splats.hit_level", gl::Format::r16f, samples);
    auto pass = builder.pass("combine levels");
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("places", visible.splats.hierarchy.places)
        .reads("winners", visible.winner)
        .reads("depths", visible.depth)
        .reads(visible.gbuffer.position)
        .reads("directions", visible.directions.directions)
        .writes("distance_image", distance)
        .writes("nearest_image", visible.nearest)
        .writes("level_image", visible.hit_level);
    passes::bounce::compute_by_tiles(
        pass, builder, {{"methods/deep-screen-space/splatting/combine.comp"}},
        Combine{visible.splats.hierarchy.levels, samples, nearest_decides(visible.splats)});
    return distance;
}

}  // namespace ir::methods::deep_screen_space
