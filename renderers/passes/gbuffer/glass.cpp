#include "renderers/passes/gbuffer/glass.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/draw_scene.h"

namespace ir::passes {
namespace {

using graph::PassContext;

/// Textures only lower it.
bool may_be_glass(const scene::Material& material) {
    return material.transmission > mostly_glass && !material.unlit;
}

/// Of the materials of triangles, each of which has one range.
std::ptrdiff_t glass_count(const graph::FrameInputs& inputs) {
    return std::ranges::count_if(inputs.world->ranges, [&](const scene::MaterialRange& range) {
        return may_be_glass(inputs.scene->materials.at(static_cast<std::size_t>(range.material)));
    });
}

/// Adds up logarithms, in the order of triangles.
void draw_glass(const PassContext& p, const SceneBuffers& s, const GBuffer& g, bool normal_maps) {
    const auto& gl = p.api();
    const PassContext::Attachment depth{g.depth};
    p.bind_framebuffer({{*g.glass}, {g.valid}}, &depth);
    const float zero[4] = {0, 0, 0, 0};
    gl.ClearBufferfv(GL_COLOR, 0, zero);
    const auto& program = p.use({{"passes/scene/triangles.vert", "passes/gbuffer/glass.frag"}});
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthMask(GL_FALSE);
    gl.Enablei(GL_BLEND, 0);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    draw_scene(p, s, program, normal_maps, may_be_glass);
    gl.Disablei(GL_BLEND, 0);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_DEPTH_TEST);
}

void exponentiate(const PassContext& p) {
    p.barrier();
    const auto& program = p.use({{"passes/gbuffer/glass.comp"}});
    program.dispatch(p.inputs().view.width, p.inputs().view.height);
}

}  // namespace

bool has_glass(const graph::FrameInputs& inputs) {
    return glass_count(inputs) > 0;
}

std::optional<graph::ImageRef> glass_before(graph::GraphBuilder& builder, const SceneBuffers& scene,
                                            const GBuffer& gbuffer, bool normal_maps) {
    if (!has_glass(builder.inputs())) return {};
    auto g = gbuffer;
    g.glass = builder.image(
        {.text =
             {.key = "gbuffer.glass",
              .label = "Glass",
              .doc =
                  "The fraction of the light that glass before the visible surface lets straight through. A: "
                  "how many surfaces of glass",
              .semantic = Semantic::albedo},
         .format = gl::Format::rgba32f});
    const auto pixels = builder.counter({.key = "gbuffer.glass_pixels",
                                         .label = "Glass pixels",
                                         .doc = "Drawn as what lies behind the glass, and not valid."});
    auto pass = builder.pass("glass");
    reads_scene(pass, scene);
    pass.reads(g.position)
        .writes("glass", *g.glass)
        .writes(g.valid, g.depth)
        .counts("Pixels", pixels)
        .execute([=](PassContext& p) {
            draw_glass(p, scene, g, normal_maps);
            exponentiate(p);
        });
    return g.glass;
}

void see_through_glass(graph::GraphBuilder& builder, const GBuffer& gbuffer, graph::ImageRef radiance) {
    if (!gbuffer.glass) return;
    builder.note(
        "glass is drawn as what lies behind it, straight through, without reflections; its pixels are "
        "not valid (" +
        std::to_string(glass_count(builder.inputs())) + " of " +
        std::to_string(builder.inputs().world->ranges.size()) + " materials)");
    builder.pass("through glass")
        .reads("glass", *gbuffer.glass)
        .writes("radiance", radiance)
        .compute({{"passes/gbuffer/through_glass.comp"}}, radiance);
}

void note_opaque_glass(graph::GraphBuilder& builder, const GBuffer& gbuffer, const std::string& carriers) {
    if (!gbuffer.glass) return;
    builder.note("glass is opaque to " + carriers +
                 ": indirect light that passes it, or that it reflects, is missing; the reference has both");
}

}  // namespace ir::passes
