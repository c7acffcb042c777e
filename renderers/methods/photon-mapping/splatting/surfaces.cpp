#include "renderers/methods/photon-mapping/splatting/stages.h"

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"

namespace ir::methods::photon_mapping {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, gl::Format format, int divisor,
                        graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = format;
    desc.extent = graph::Extent::view(1.0f / static_cast<float>(divisor));
    return builder.image(std::move(desc));
}

void draw(const graph::PassContext& p, const SplatSurfaces& s) {
    const graph::PassContext::Attachment stencil{s.stencil};
    p.bind_framebuffer({{s.depth}}, &stencil);
    const auto& program = p.use({{"lib/full_screen.vert", "methods/photon-mapping/splatting/surfaces.frag"}});
    program.set(splat_view(p.inputs().view, s.divisor));
    p.api().Enable(GL_DEPTH_TEST);
    p.api().DepthFunc(GL_ALWAYS);
    p.draw_full_screen();
}

}  // namespace

SplatSurfaces splat_surfaces(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                             const passes::GBuffer& gbuffer, int divisor) {
    SplatSurfaces s;
    s.divisor = divisor;
    s.gbuffer = gbuffer;
    s.scene = scene;
    s.depth = declare(builder, gl::Format::r32f, divisor, builder.text_of_output("splat.depth"));
    s.stencil = declare(builder, gl::Format::depth32f, divisor,
                        {"splat.stencil", "Stencil of the splatting",
                         "Reversed depth of the surface: what lies behind it is not drawn. 1: background"});
    builder.pass("surfaces to splat on")
        .reads(gbuffer.position)
        .writes(s.depth, s.stencil)
        .execute([=](graph::PassContext& p) { draw(p, s); });
    return s;
}

}  // namespace ir::methods::photon_mapping
