#include "renderers/methods/deep-screen-space/splatting/additive.h"

#include "renderers/methods/deep-screen-space/splatting/steps.h"

namespace ir::methods::deep_screen_space {
namespace {

using graph::ImageRef;
using graph::PassContext;

passes::bounce::Receivers receivers_of(const passes::SceneBuffers& scene, const passes::GBuffer& gbuffer,
                                       const Parameters& parameters) {
    passes::bounce::DirectionOptions options;
    options.parameters = parameters.directions;
    options.light = parameters.transport.paths != Transport::Paths::ao;
    options.materials = parameters.transport.materials;
    return {scene, gbuffer, options};
}

/// Floats of 32 bits: to a sum of thousands half floats cannot add small numbers.
ImageRef declare_stack(graph::GraphBuilder& builder, const Additive& additive, graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = additive.is_light() ? gl::Format::rgba32f : gl::Format::r32f;
    desc.extent = graph::Extent::fixed(additive.splats.hierarchy.width, additive.splats.hierarchy.height);
    desc.layers = additive.splats.hierarchy.levels;
    return builder.image(std::move(desc));
}

void clear_layer(const gl::Api& gl, const Additive& additive) {
    constexpr float nothing[4] = {};
    gl.ClearBufferfv(GL_COLOR, 0, nothing);
    if (additive.has_gloss()) gl.ClearBufferfv(GL_COLOR, 1, nothing);
}

/// Constants of additive.frag.
struct AdditiveSplat {
    SplatConstants splat;
    ShareConstants share;
    IR_FIELDS(splat, share)
};

/// Sums are in the order of the surfels.
const gl::Program& bind_layer(const PassContext& p, const Additive& additive, const SplatLayer& layer) {
    std::vector<PassContext::Attachment> targets{{additive.splatted, layer.level}};
    if (additive.has_gloss()) targets.push_back({additive.glossy, layer.level});
    p.bind_framebuffer(targets);
    const auto& gl = p.api();
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE);
    if (layer.is_first) clear_layer(gl, additive);
    const auto& program = p.use(with_share({{folder + "splat.vert", folder + "additive.frag"}}, additive));
    program.set(
        AdditiveSplat{splat_constants(additive.splats, layer), share_constants(p.inputs(), additive)});
    return program;
}

void splat(graph::GraphBuilder& builder, Additive& additive) {
    additive.splatted = declare_stack(builder, additive, builder.text_of_output("additive.splatted"));
    if (additive.is_light() && additive.parameters().transport.materials != Transport::Materials::lambert)
        additive.glossy = declare_stack(builder, additive,
                                        {.key = "additive.glossy",
                                         .label = "Glossy levels in sub-images",
                                         .doc = "Light that microfacets reflect: a layer per level."});
    auto pass = builder.pass("splat");
    additive.receivers.declare_reads(pass);
    pass.writes(additive.splatted);
    if (additive.has_gloss()) pass.writes(additive.glossy);
    if (additive.has_highlights()) {
        pass.reads("SurfelLights", additive.splats.surfels.lights);
        additive.senders.read_by(pass);
    }
    draw_splats(pass, additive.splats,
                [=](const PassContext& p, const SplatLayer& layer) -> const gl::Program& {
                    return bind_layer(p, additive, layer);
                });
}

void read_levels(graph::PassBuilder& pass, const std::string& name, const LevelSums& sums) {
    for (std::size_t level = 0; level < sums.levels.size(); ++level)
        pass.reads(name + "[" + std::to_string(level) + "]", sums.levels[level]);
}

ImageRef resolve(graph::GraphBuilder& builder, const Additive& additive, const LevelSums& sums,
                 const LevelSums& glossy, graph::ResourceText text) {
    const auto format = additive.is_light() ? gl::Format::rgba32f : gl::Format::r32f;
    const auto& gbuffer = additive.receivers.gbuffer;
    const auto sum = builder.output("additive.sum", {.format = format});
    const auto result = builder.image({.text = std::move(text), .format = format});
    auto pass = builder.pass("add levels");
    read_levels(pass, "levels_texture", sums);
    read_levels(pass, "glossy_texture", glossy);
    pass.reads(gbuffer.albedo, gbuffer.material, gbuffer.position)
        .writes("sum_image", sum)
        .writes("result_image", result);
    gl::ProgramSource source{{folder + "additive_resolve.comp"}};
    source.defines["LEVELS"] = std::to_string(sums.levels.size());
    additive.receivers.define(source);
    pass.compute(source, result);
    return result;
}

}  // namespace

gl::ProgramSource with_share(gl::ProgramSource source, const Additive& additive) {
    additive.receivers.define(source);
    source.defines["GLOSSY_SENDERS"] = additive.has_highlights() ? "1" : "0";
    return source;
}

ShareConstants share_constants(const graph::FrameInputs& inputs, const Additive& additive) {
    const auto& transport = additive.parameters().transport;
    const bool smooth = transport.falloff == Transport::Falloff::smooth;
    return {.senders = sender_constants(inputs, additive.parameters()),
            .receiver = additive.receivers.constants(inputs),
            .black_backs = additive.parameters().backs != Backs::lit,
            .falloff_distance = smooth ? transport.max_distance : 0.0f};
}

ImageRef splat_additive(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                        const passes::GBuffer& gbuffer, const passes::ShadowMaps& shadow,
                        const Hierarchy& hierarchy, const Surfels& surfels, const Parameters& parameters,
                        graph::ResourceText text) {
    Additive additive;
    additive.splats = declare_splats(builder, hierarchy, surfels, parameters, passes::bounce::Batches(1));
    additive.receivers = receivers_of(scene, gbuffer, parameters);
    if (additive.has_highlights()) additive.senders = sender_inputs(builder, scene, shadow);
    splat(builder, additive);
    const auto sums = blur_levels(builder, gbuffer, hierarchy, additive.splatted, parameters);
    LevelSums glossy;
    if (additive.has_gloss()) glossy = blur_levels(builder, gbuffer, hierarchy, additive.glossy, parameters);
    show_unshuffled(builder, hierarchy, additive.splatted);
    count_cover(builder, additive.splats);
    show_culling(builder, additive.splats);
    explain_additive(builder, additive);
    return resolve(builder, additive, sums, glossy, std::move(text));
}

}  // namespace ir::methods::deep_screen_space
