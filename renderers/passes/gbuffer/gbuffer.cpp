#include "renderers/passes/gbuffer/gbuffer.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/draw_scene.h"
#include "renderers/passes/gbuffer/gbuffer_on_host.h"
#include "renderers/passes/gbuffer/glass.h"
#include "renderers/passes/gbuffer/peeling.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;
using graph::ImageRef;
using graph::PassContext;

/// In shaders "gbuffer.geometric_normal" is gbuffer_geometric_normal.
ImageRef declare_image(GraphBuilder& builder, int layer, gl::Format format, graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.name = text.key;
    std::ranges::replace(desc.name, '.', '_');
    desc.text = of_layer(std::move(text), layer);
    desc.format = format;
    return builder.image(std::move(desc));
}

GBuffer declare_images(GraphBuilder& builder, int layer = 1) {
    using gl::Format;
    const auto declare = [&](Format format, graph::ResourceText text) {
        return declare_image(builder, layer, format, std::move(text));
    };
    GBuffer g;
    g.depth = declare(Format::depth32f,
                      {"gbuffer.depth", "Depth", "Normalised device depth; 1: background", Semantic::depth});
    g.position = declare(Format::rgba32f, graph::text_of(position_output()));
    g.normal = declare(Format::rgba16f, graph::text_of(normal_output()));
    g.geometric_normal =
        declare(Format::rgba32f,
                {"gbuffer.geometric_normal", "Geometric normal",
                 "Of the triangle's plane, turned to the viewer; w: distance of the point along the previous "
                 "frame's view axis, m",
                 Semantic::normal});
    g.albedo = declare(Format::rgba16f, graph::text_of(albedo_output()));
    g.material = declare(Format::rgba16f, {"gbuffer.material", "Material",
                                           "x metallic, y roughness, z unlit, w index (exact up to 2048)"});
    g.emission =
        declare(Format::rgba16f, {"gbuffer.emission", "Emission", "", Semantic::radiance, "W/(m² sr)"});
    g.velocity =
        declare(Format::rg16f, {"gbuffer.velocity", "Velocity",
                                "From the previous frame's place to this one's", Semantic::velocity, "px"});
    g.valid = declare(Format::r8, graph::text_of(valid_output()));
    return g;
}

void clear(const gl::Api& gl, int colours) {
    const float zero[4] = {0, 0, 0, 0}, far = 1;
    for (int i = 0; i < colours; ++i) gl.ClearBufferfv(GL_COLOR, i, zero);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);
}

/// Constants of gbuffer.frag.
struct DrawSurfaces {
    glm::mat4 previous_clip_from_world;
    glm::vec4 previous_depth_row;
    glm::vec2 size_px;
    bool see_through;
    IR_FIELDS(previous_clip_from_world, previous_depth_row, size_px, see_through)
};

void draw_surfaces(const PassContext& p, const SceneBuffers& s, const GBuffer& g,
                   const GBufferOptions& options, bool is_peeled) {
    const auto& gl = p.api();
    const auto &view = p.inputs().view, &previous = p.inputs().previous_view;
    const PassContext::Attachment depth{g.depth};
    p.bind_framebuffer({{g.position},
                        {g.normal},
                        {g.geometric_normal},
                        {g.albedo},
                        {g.material},
                        {g.emission},
                        {g.velocity},
                        {g.valid}},
                       &depth);
    clear(gl, 8);
    gl::ProgramSource source{{"passes/scene/triangles.vert", "passes/gbuffer/gbuffer.frag"}};
    if (is_peeled) source.defines["PEELED"] = "1";
    const auto& program = p.use(source);
    program.set(DrawSurfaces{
        .previous_clip_from_world = previous.clip_from_world(),
        .previous_depth_row = -glm::vec4(glm::transpose(previous.view_from_world)[2]),
        .size_px = {view.width, view.height},
        .see_through = options.sees_through_glass,
    });
    gl.Enable(GL_DEPTH_TEST);
    draw_scene(p, s, program, options.normal_maps, [](const scene::Material&) { return true; });
    gl.Disable(GL_DEPTH_TEST);
}

/// Declares the pass; `nearer` is the layer before, if there is one.
void declare_pass(GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& g,
                  const GBufferOptions& options, const GBuffer* nearer = nullptr, int layer = 1) {
    const bool has_two_bodies = has_host_body(builder.inputs(), options);
    if (has_two_bodies && builder.inputs().processor == Processor::host) {
        gbuffer_on_host(builder, g, options, nearer, layer);
        return;
    }
    auto pass = builder.pass(pass_of_layer("G-buffer", layer));
    if (has_two_bodies) pass.has_two_bodies();
    reads_scene(pass, scene);
    if (nearer) pass.reads("nearer_position", nearer->position);
    pass.writes(g.depth, g.position, g.normal, g.geometric_normal, g.albedo, g.material, g.emission,
                g.velocity, g.valid)
        .execute([=](PassContext& p) { draw_surfaces(p, scene, g, options, layer > 1); });
}

}  // namespace

graph::ResourceText of_layer(graph::ResourceText text, int number) {
    if (number == 1) return text;
    text.key += '.' + std::to_string(number);
    text.label = pass_of_layer(text.label, number);
    text.doc +=
        " Of a layer behind what is seen, by depth peeling: normals are those of the triangles' fronts, "
        "and light goes along them, by rays.";
    return text;
}

std::string pass_of_layer(const std::string& name, int number) {
    return number == 1 ? name : name + ", layer " + std::to_string(number);
}

OutputDescription position_output() {
    return {.key = "gbuffer.position",
            .label = "Position",
            .semantic = Semantic::position,
            .unit = "m",
            .doc = "Of what is seen in the pixel's centre, world space; w: distance to the eye."};
}

OutputDescription normal_output() {
    return {.key = "gbuffer.normal",
            .label = "Shading normal",
            .semantic = Semantic::normal,
            .doc = "World space, turned to the viewer."};
}

OutputDescription albedo_output() {
    return {.key = "gbuffer.albedo",
            .label = "Base colour",
            .semantic = Semantic::albedo,
            .doc = "Linear; a: transmission."};
}

OutputDescription valid_output() {
    return {.key = "valid",
            .label = "Valid",
            .semantic = Semantic::mask,
            .doc =
                "1 where the result counts; 0 on the background and on glass that is looked through. Where "
                "rays find what is seen it is 1 everywhere."};
}

GBufferOptions gbuffer_options(const Transport& transport) {
    const bool has_materials = transport.paths != Transport::Paths::ao;
    return {.normal_maps = transport.normal_maps,
            .sees_through_glass = !has_materials || transport.materials != Transport::Materials::lambert};
}

GBuffer gbuffer(GraphBuilder& builder, const SceneBuffers& scene, const GBufferOptions& options) {
    auto g = declare_images(builder);
    declare_pass(builder, scene, g, options);
    if (options.sees_through_glass) g.glass = glass_before(builder, scene, g, options.normal_maps);
    return g;
}

PeeledLayer peel(GraphBuilder& builder, const SceneBuffers& scene, const GBuffer& nearer, int number,
                 const GBufferOptions& options) {
    const PeeledLayer layer{number, declare_images(builder, number)};
    declare_pass(builder, scene, layer.surface, options, &nearer, number);
    return layer;
}

}  // namespace ir::passes
