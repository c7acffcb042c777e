#include "renderers/methods/deep-screen-space/splatting/additive.h"

#include <algorithm>

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

constexpr int largest_radius = 64;  // of the blur

gl::Format format_of(const graph::GraphBuilder& builder, ImageRef image) {
    return builder.images().at(static_cast<std::size_t>(image.index)).format;
}

/// Constants of unshuffle.comp.
struct Unshuffle {
    int level;
    IR_FIELDS(level)
};

ImageRef unshuffled(graph::GraphBuilder& builder, const Hierarchy& hierarchy, ImageRef stack,
                    const std::string& key, int level) {
    graph::ImageDesc desc;
    desc.text = {.key = key, .label = "Level " + std::to_string(level) + ", unshuffled"};
    desc.format = format_of(builder, stack);
    const auto image = builder.image(std::move(desc));
    builder.pass("unshuffle: " + key)
        .reads("places_texture", hierarchy.places)
        .reads("stack", stack)
        .writes("result", image)
        .compute({{folder + "unshuffle.comp"}}, image, Unshuffle{level});
    return image;
}

/// A sum over surfels on its way from the sub-images to the picture.
struct LevelSums {
    graph::ImageRef stack;                ///< as splatted: of the hierarchy's size, a layer per level
    std::vector<graph::ImageRef> levels;  ///< unshuffled and blurred, of the view's size
};

/// Unshuffles each level and blurs it, over 2^l times as many pixels. `stack` is what was splatted.
LevelSums blur_levels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                      const Hierarchy& hierarchy, ImageRef stack, const Parameters& parameters) {
    const auto& options = parameters.reconstruction.blur;
    const auto name = builder.images().at(static_cast<std::size_t>(stack.index)).text.key;
    LevelSums sums{stack, {}};
    for (int level = 0; level < hierarchy.levels; ++level) {
        const auto key = name + ".level_" + std::to_string(level);
        const auto image = unshuffled(builder, hierarchy, stack, key, level);
        auto wider = options;
        wider.radius = std::min(options.used_radius() << level, largest_radius);
        sums.levels.push_back(
            passes::blur(builder, gbuffer, image, wider,
                         {.key = key + ".blurred",
                          .label = "Level " + std::to_string(level) + ", blurred",
                          .doc = "Over " + std::to_string(wider.radius) + " pixels on either side."}));
    }
    return sums;
}

/// "additive.levels", the levels unshuffled, for people to look at.
void show_unshuffled(graph::GraphBuilder& builder, const Hierarchy& hierarchy, ImageRef stack) {
    const auto levels =
        builder.output("additive.levels", {.format = format_of(builder, stack), .layers = hierarchy.levels});
    builder.pass("unshuffle levels")
        .reads("places_texture", hierarchy.places)
        .reads("stack", stack)
        .writes("result", levels)
        .execute([=](graph::PassContext& p) {
            const auto& program = p.use({{folder + "unshuffle.comp"}, {{"TO_STACK", "1"}}});
            const auto shape = p.shape(levels);
            for (int level = 0; level < hierarchy.levels; ++level) {
                program.set(Unshuffle{level});
                program.dispatch(shape.width, shape.height);
            }
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

std::vector<OutputDescription> additive_outputs() {
    const Condition additive{"visibility", {false}};
    return {
        {.key = "additive.sum",
         .label = "Sum of surfels",
         .doc = "What all surfels do to a pixel, blurred level by level and added up, before it becomes the "
                "result. Ambient occlusion: form factors, whose sum exceeds 1 where surfels hide each other, "
                "and is more than what is closed wherever they do. Light: radiance that a white Lambert "
                "surface would reflect, W/(m² sr).",
         .active_when = additive},
        {.key = "additive.levels",
         .label = "Levels",
         .kind = OutputKind::stack,
         .doc =
             "What surfels add to each pixel on each level (a layer), that is by distance, before the blur.",
         .active_when = additive},
        {.key = "additive.splatted",
         .label = "Levels in sub-images",
         .kind = OutputKind::stack,
         .doc = "The same where it was splatted: a layer per level, pixels in the sub-images of their level.",
         .active_when = additive},
        {.key = "splats.cover",
         .label = "Splats of places",
         .kind = OutputKind::stack,
         .semantic = Semantic::count,
         .doc = "Red: how many splats cover a place of the hierarchical framebuffer, which is what is paid; "
                "green: how many of them have its surface within reach. A layer for each sample and, within "
                "it, level.",
         .active_when = additive},
        {.key = "additive.explain.surfels",
         .label = "Surfels added to the pixel",
         .kind = OutputKind::glyphs,
         .doc =
             "Surfels that were added to the pixel, those that give most first; found by a search over all "
             "surfels. surfel: 1 + index; level: where it was splatted; distance: m to its centre; given: "
             "occlusion, or what a white Lambert surface reflects of its light; glossy: what microfacets "
             "do. Before the blur.",
         .when_empty = no_surface,
         .explains = true,
         .active_when = additive},
        {.key = "additive.explain.levels",
         .label = "Levels of the pixel, added",
         .kind = OutputKind::table,
         .doc = "For each level how many surfels were added to the pixel, and what all of them give; kept: "
                "what the framebuffer holds, which has to be the same but for rounding.",
         .when_empty = no_surface,
         .explains = true,
         .active_when = additive},
    };
}

}  // namespace ir::methods::deep_screen_space
