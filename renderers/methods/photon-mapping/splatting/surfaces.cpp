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

/// Constants of surfaces.frag.
struct SurfacesBelow {
    SplatView view;
    passes::PixelRays rays;
    IR_FIELDS(view, rays)
};

void draw(const graph::PassContext& p, const SplatSurfaces& s) {
    const bool low = s.divisor > 1;
    const graph::PassContext::Attachment stencil{s.stencil};
    p.bind_framebuffer(low ? std::vector<graph::PassContext::Attachment>{{s.depth}, {s.surfaces}}
                           : std::vector<graph::PassContext::Attachment>{{s.depth}},
                       &stencil);
    gl::ProgramSource source{{"lib/full_screen.vert", "methods/photon-mapping/splatting/surfaces.frag"}};
    if (low) source.defines["LOW_RESOLUTION"] = "1";
    const auto& program = p.use(source);
    const auto& view = p.inputs().view;
    program.set(SurfacesBelow{splat_view(view, s.divisor), passes::pixel_rays(view)});
    p.api().Enable(GL_DEPTH_TEST);
    p.api().DepthFunc(GL_ALWAYS);
    p.draw_full_screen();
}

}  // namespace

SplatSurfaces splat_surfaces(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, int divisor) {
    SplatSurfaces s;
    s.divisor = divisor;
    s.depth = declare(builder, gl::Format::r32f, divisor, builder.text_of_output("splat.depth"));
    s.stencil = declare(builder, gl::Format::depth32f, divisor,
                        {"splat.stencil", "Stencil of the splatting",
                         "Reversed depth of the closest surface: what lies behind it is not drawn. 1: "
                         "background"});
    s.surfaces =
        divisor == 1
            ? s.depth
            : declare(builder, gl::Format::rg32f, divisor,
                      {"splat.surfaces", "Closest and farthest surface",
                       "Depths of the texel's closest and farthest surface, carried on to its middle: both "
                       "have to lie within a kernel",
                       Semantic::depth, "m"});
    auto pass = builder.pass("surfaces to splat on");
    pass.reads(gbuffer.position, gbuffer.geometric_normal).writes(s.depth, s.stencil);
    if (divisor > 1) pass.writes(s.surfaces);
    pass.execute([=](graph::PassContext& p) { draw(p, s); });
    return s;
}

}  // namespace ir::methods::photon_mapping
