#include "renderers/passes/gbuffer/gbuffer.h"

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::passes {
namespace {

using graph::GraphBuilder;
using graph::ImageRef;
using graph::PassContext;

ImageRef declare(GraphBuilder& builder, gl::Format format, graph::ResourceText text) {
    graph::ImageDesc desc;
    desc.text = std::move(text);
    desc.format = format;
    return builder.image(std::move(desc));
}

GBuffer declare_images(GraphBuilder& builder) {
    using gl::Format;
    GBuffer g;
    g.depth = declare(builder, Format::depth32f,
                      {"gbuffer.depth", "Depth", "Normalised device depth; 1: background", Semantic::depth});
    g.position = declare(
        builder, Format::rgba32f,
        {"gbuffer.position", "Position", "World space; w: distance to the eye", Semantic::position, "m"});
    g.normal =
        declare(builder, Format::rgba16f,
                {"gbuffer.normal", "Shading normal", "World space, turned to the viewer", Semantic::normal});
    g.geometric_normal =
        declare(builder, Format::rgba32f,
                {"gbuffer.geometric_normal", "Geometric normal",
                 "Of the triangle's plane, turned to the viewer; w: distance of the point along the previous "
                 "frame's view axis, m",
                 Semantic::normal});
    g.albedo = declare(builder, Format::rgba16f,
                       {"gbuffer.albedo", "Base colour", "Linear; a: transmission", Semantic::albedo});
    g.material = declare(
        builder, Format::rgba16f,
        {"gbuffer.material", "Material", "x metallic, y roughness, z unlit, w index (exact up to 2048)"});
    g.emission = declare(builder, Format::rgba16f,
                         {"gbuffer.emission", "Emission", "", Semantic::radiance, "W/(m² sr)"});
    g.velocity = declare(builder, Format::rg16f,
                         {"gbuffer.velocity", "Velocity", "From the previous frame's place to this one's",
                          Semantic::velocity, "px"});
    g.valid =
        declare(builder, Format::r8,
                {"valid", "Valid", "1 where the result counts; background and glass are 0", Semantic::mask});
    return g;
}

void clear(const gl::Api& gl, int colours) {
    const float zero[4] = {0, 0, 0, 0}, far = 1;
    for (int i = 0; i < colours; ++i) gl.ClearBufferfv(GL_COLOR, i, zero);
    gl.ClearBufferfv(GL_DEPTH, 0, &far);
}

void bind_buffers(const PassContext& p, const SceneBuffers& s) {
    p.bind_buffer(0, s.positions);
    p.bind_buffer(1, s.normals);
    p.bind_buffer(2, s.tangents);
    p.bind_buffer(3, s.uv0);
    p.bind_buffer(4, s.uv1);
    p.bind_buffer(5, s.colours);
    p.bind_buffer(6, s.instances);
    p.bind_buffer(7, s.indices);
    p.bind_buffer(8, s.motion);
    p.bind_buffer(9, s.opacity);
    p.bind_buffer(10, s.opacity_words);
    p.bind_buffer(11, s.materials);
}

/// Binds the textures that the material has to units 0, 1, …; a bit for each.
int bind_textures(const PassContext& p, const SceneBuffers& s, const scene::Material& material) {
    const scene::TextureSlot* slots[] = {&material.base_colour_texture, &material.metallic_roughness_texture,
                                         &material.normal_texture, &material.emission_texture,
                                         &material.transmission_texture};
    int unit = 0, bound = 0;
    for (const auto* slot : slots) {
        if (slot->texture >= 0) {
            const auto index = static_cast<std::size_t>(slot->texture);
            p.bind_texture(unit, s.textures.at(index), p.inputs().scene->textures.at(index).sampler);
            bound |= 1 << unit;
        }
        ++unit;
    }
    return bound;
}

void draw_ranges(const PassContext& p, const SceneBuffers& s, const gl::Program& program) {
    for (const auto& range : p.inputs().world->ranges) {
        const auto& material = p.inputs().scene->materials.at(static_cast<std::size_t>(range.material));
        program.set("textures", bind_textures(p, s, material));
        program.set("material_index", range.material);
        p.api().DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first_triangle),
                           static_cast<GLsizei>(3 * range.triangle_count));
    }
}

void draw(const PassContext& p, const SceneBuffers& s, const GBuffer& g, const GBufferOptions& options) {
    const auto& gl = p.api();
    const auto& view = p.inputs().view;
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
    const auto& program = p.program({{"passes/gbuffer/gbuffer.vert", "passes/gbuffer/gbuffer.frag"}});
    program.use();
    program.set("clip_from_world", view.clip_from_world());
    program.set("previous_clip_from_world", p.inputs().previous_view.clip_from_world());
    program.set("previous_depth_row",
                -glm::vec4(glm::transpose(p.inputs().previous_view.view_from_world)[2]));
    program.set("eye_ws", view.eye_ws);
    program.set("view_axis_ws", -glm::vec3(glm::transpose(view.view_from_world)[2]));
    program.set("size_px", glm::vec2(view.width, view.height));
    program.set("normal_maps", options.normal_maps ? 1 : 0);
    set_pixel_rays(program, view);
    bind_buffers(p, s);
    p.bind_empty_vertex_array();
    gl.Enable(GL_DEPTH_TEST);
    draw_ranges(p, s, program);
    gl.Disable(GL_DEPTH_TEST);
}

}  // namespace

GBuffer gbuffer(GraphBuilder& builder, const SceneBuffers& scene, const GBufferOptions& options) {
    const auto g = declare_images(builder);
    auto pass = builder.pass("G-buffer");
    pass.reads(scene.positions, scene.normals, scene.tangents, scene.uv0, scene.uv1, scene.colours,
               scene.instances, scene.indices, scene.motion, scene.opacity, scene.opacity_words,
               scene.materials);
    for (const auto texture : scene.textures) pass.reads(texture);
    pass.writes(g.depth, g.position, g.normal, g.geometric_normal, g.albedo, g.material, g.emission,
                g.velocity, g.valid)
        .execute([=](PassContext& p) { draw(p, scene, g, options); });
    return g;
}

}  // namespace ir::passes
