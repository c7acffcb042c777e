#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

graph::ImageRef declare_of_samples(graph::GraphBuilder& builder, const std::string& key, gl::Format format,
                                   int samples) {
    graph::ImageDesc desc;
    desc.text = visible_text(key);
    desc.format = format;
    desc.layers = samples;
    return builder.image(std::move(desc));
}

const gl::Program& bind(const graph::PassContext& p, const VisibleSplats& visible, graph::ImageRef distance) {
    const auto& program = p.program({{"methods/deep-screen-space/splatting/combine.comp"}});
    program.use();
    p.bind_buffer(0, visible.splats.surfels);
    p.bind_texture(0, visible.splats.hierarchy.places);
    p.bind_texture(1, visible.winner);
    p.bind_texture(2, visible.gbuffer.position);
    p.bind_texture(3, visible.directions.directions);
    p.bind_texture(4, visible.depth);
    p.bind_storage_image(0, distance);
    p.bind_storage_image(1, visible.nearest);
    p.bind_storage_image(2, visible.hit_level);
    program.set("levels", visible.splats.hierarchy.levels);
    program.set("samples", visible.splats.samples);
    program.set("nearest_decides", nearest_decides(visible.splats) ? 1 : 0);
    return program;
}

}  // namespace

graph::ImageRef combine_levels(graph::GraphBuilder& builder, VisibleSplats& visible) {
    const int samples = visible.splats.samples;
    const auto distance = passes::bounce::declare_distance(builder, samples);
    visible.nearest = declare_of_samples(builder, "splats.nearest", gl::Format::r32ui, samples);
    visible.hit_level = declare_of_samples(builder, "splats.hit_level", gl::Format::r16f, samples);
    auto pass = builder.pass("combine levels");
    pass.reads(visible.splats.surfels, visible.splats.hierarchy.places, visible.winner, visible.depth,
               visible.gbuffer.position, visible.directions.directions)
        .writes(distance, visible.nearest, visible.hit_level);
    passes::bounce::execute_by_tiles(pass, builder, [=](graph::PassContext& p) -> const gl::Program& {
        return bind(p, visible, distance);
    });
    return distance;
}

}  // namespace ir::methods::deep_screen_space
