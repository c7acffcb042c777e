#include "renderers/methods/deep-screen-space/splatting/visible.h"

#include "renderers/methods/deep-screen-space/splatting/host/splat_on_host.h"
#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {
namespace {

graph::ImageRef declare_layers(graph::GraphBuilder& builder, const Splats& splats, const std::string& key,
                               gl::Format format) {
    return builder.output(key,
                          {.format = format,
                           .extent = graph::Extent::fixed(splats.hierarchy.width, splats.hierarchy.height),
                           .layers = splats.samples * splats.hierarchy.levels,
                           .fingerprint = splats.fingerprint});
}

/// Of a stack's layer.
void clear_layer(const gl::Api& gl) {
    constexpr GLuint nobody[4] = {};
    constexpr float farthest = 1;
    gl.ClearBufferuiv(GL_COLOR, 0, nobody);
    gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

/// Constants of visible.frag.
struct Visible {
    VisibleLevel of_level;
    int level, sample_index;
    IR_FIELDS(of_level, level, sample_index)
};

/// LESS: of equal depths the first surfel wins, in every run.
const gl::Program& bind_layer(const graph::PassContext& p, const VisibleSplats& visible,
                              const SplatLayer& layer) {
    const int index = layer.sample * visible.splats.hierarchy.levels + layer.level;
    const graph::PassContext::Attachment depth{visible.depth, index};
    p.bind_framebuffer({{visible.winner, index}}, &depth);
    const auto& gl = p.api();
    gl.Disable(GL_BLEND);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    if (layer.is_first) clear_layer(gl);
    const auto& program =
        p.use(with_acceptance({{folder + "splat.vert", folder + "visible.frag"}}, visible.splats));
    program.set(Visible{visible_level(visible.splats), layer.level, layer.sample});
    return program;
}

}  // namespace

VisibleLevel visible_level(const Splats& splats) {
    const auto& parameters = splats.parameters;
    return {influence_constants(splats), parameters.coverage, parameters.transport.max_distance,
            parameters.shells == Shells::full_discs};
}

gl::ProgramSource with_acceptance(gl::ProgramSource source, const Splats& splats) {
    source.defines["EXACT"] = splats.parameters.level0 == Level0::triangles ? "1" : "0";
    source.defines["DISCS"] = std::to_string(static_cast<int>(splats.parameters.discs));
    source.defines["OPEN_BACKS"] = splats.parameters.backs == Backs::open ? "1" : "0";
    return source;
}

void read_acceptance(graph::PassBuilder& pass, const VisibleSplats& visible) {
    if (visible.exact.index >= 0) pass.reads("exact_rays", visible.exact);
    if (visible.splats.parameters.discs != Discs::seen) return;
    pass.reads("BvhNodes", visible.bvh.nodes)
        .reads("BvhTriangles", visible.bvh.triangles)
        .reads("BvhMasks", visible.bvh.masks)
        .reads(visible.scene.opacity, visible.scene.opacity_words);
}

namespace {

/// By the rasteriser: a fragment for each surfel that may affect a pixel.
graph::ImageRef splat_on_device(graph::GraphBuilder& builder, VisibleSplats& visible) {
    auto pass = builder.pass("splat");
    pass.has_two_bodies()
        .reads("directions", visible.directions.directions)
        .reads(visible.gbuffer.geometric_normal)
        .writes(visible.depth, visible.winner);
    read_acceptance(pass, visible);
    draw_splats(pass, visible.splats,
                [=](const graph::PassContext& p, const SplatLayer& layer) -> const gl::Program& {
                    return bind_layer(p, visible, layer);
                });
    return combine_levels(builder, visible);
}

}  // namespace

passes::bounce::Samples splat_visible(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                      const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                                      const passes::bounce::Directions& directions,
                                      const Hierarchy& hierarchy, const Surfels& surfels,
                                      const Parameters& parameters) {
    const bool on_host = builder.inputs().processor == Processor::host;
    VisibleSplats visible;
    visible.splats = declare_splats(builder, hierarchy, surfels, parameters, directions.samples);
    visible.scene = scene;
    if (needs_triangles(parameters)) visible.bvh = passes::device_bvh(builder);
    visible.gbuffer = gbuffer;
    visible.directions = directions;
    visible.depth = declare_layers(builder, visible.splats, "splats.depth", gl::Format::depth32f);
    visible.winner = declare_layers(builder, visible.splats, "splats.winner", gl::Format::r32ui);
    if (parameters.level0 == Level0::triangles) trace_level0(builder, visible);
    passes::bounce::Samples samples;
    samples.distance = on_host ? splat_on_host(builder, visible) : splat_on_device(builder, visible);
    samples.incoming = parameters.transport.paths == Transport::Paths::ao
                           ? passes::bounce::visibility_of(builder, gbuffer, directions, samples.distance,
                                                           parameters.transport)
                           : resolve_light(builder, scene, shadow, visible, samples.distance);
    show_levels(builder, visible, samples.distance);
    show_culling(builder, visible.splats);
    explain_splats(builder, visible);
    return samples;
}

}  // namespace ir::methods::deep_screen_space
