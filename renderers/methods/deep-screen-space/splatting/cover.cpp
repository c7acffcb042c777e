#include "renderers/methods/deep-screen-space/splatting/splats.h"

#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {

graph::ImageRef count_cover(graph::GraphBuilder& builder, const Splats& splats) {
    const auto cover = builder.output(
        "splats.cover", {.format = gl::Format::rg32f,
                         .extent = graph::Extent::fixed(splats.hierarchy.width, splats.hierarchy.height),
                         .layers = splats.samples * splats.hierarchy.levels});
    const gl::ProgramSource source{
        {"methods/deep-screen-space/splatting/splat.vert", "methods/deep-screen-space/splatting/cover.frag"}};
    auto uncounted = splats;
    uncounted.drawn = uncounted.culled = {};
    auto pass = builder.pass("count splats of places").writes(cover);
    draw_splats(pass, uncounted,
                [=](const graph::PassContext& p, const SplatLayer& layer) -> const gl::Program& {
                    const int index = layer.sample * splats.hierarchy.levels + layer.level;
                    if (layer.is_first && index == 0) p.clear(cover);
                    p.bind_framebuffer({{cover, index}});
                    const auto& program = p.use(source);
                    program.set(splat_constants(splats, layer));
                    p.api().Enable(GL_BLEND);
                    p.api().BlendEquation(GL_FUNC_ADD);
                    p.api().BlendFunc(GL_ONE, GL_ONE);
                    return program;
                });
    return cover;
}

}  // namespace ir::methods::deep_screen_space
