#include "renderers/passes/gbuffer/draw_scene.h"

#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::passes {
namespace {

using graph::PassContext;

constexpr const char* texture_names[] = {"base_colour_texture", "metallic_roughness_texture",
                                         "normal_texture", "emission_texture", "transmission_texture"};

/// Binds the textures that the material has; a bit for each.
int bind_textures(const PassContext& p, const SceneBuffers& s, const scene::Material& material) {
    const scene::TextureSlot* slots[] = {&material.base_colour_texture, &material.metallic_roughness_texture,
                                         &material.normal_texture, &material.emission_texture,
                                         &material.transmission_texture};
    int bound = 0;
    for (int i = 0; i < 5; ++i) {
        if (slots[i]->texture < 0) continue;
        const auto index = static_cast<std::size_t>(slots[i]->texture);
        p.bind(texture_names[i], s.textures.at(index), p.inputs().scene->textures.at(index).sampler);
        bound |= 1 << i;
    }
    return bound;
}

/// Constants of gbuffer.vert and surface.glsl.
struct DrawScene {
    glm::mat4 clip_from_world;
    glm::vec3 eye_ws, view_axis_ws;
    PixelRays rays;
    bool normal_maps;
    int textures, material_index;
    IR_FIELDS(clip_from_world, eye_ws, view_axis_ws, rays, normal_maps, textures, material_index)
};

}  // namespace

void reads_scene(graph::PassBuilder& pass, const SceneBuffers& scene) {
    pass.reads(scene.positions, scene.normals, scene.tangents, scene.uv0, scene.uv1, scene.colours,
               scene.instances, scene.indices, scene.opacity, scene.opacity_words, scene.materials);
    for (const auto texture : scene.textures) pass.reads(texture);
    for (const auto* name : texture_names) pass.reads(name, graph::ImageRef{});
}

void draw_scene(const PassContext& p, const SceneBuffers& s, const gl::Program& program, bool normal_maps,
                const std::function<bool(const scene::Material&)>& is_drawn) {
    const auto& view = p.inputs().view;
    DrawScene constants{.clip_from_world = view.clip_from_world(),
                        .eye_ws = view.eye_ws,
                        .view_axis_ws = -glm::vec3(glm::transpose(view.view_from_world)[2]),
                        .rays = pixel_rays(view),
                        .normal_maps = normal_maps,
                        .textures = 0,
                        .material_index = 0};
    p.bind_empty_vertex_array();
    for (const auto& range : p.inputs().world->ranges) {
        const auto& material = p.inputs().scene->materials.at(static_cast<std::size_t>(range.material));
        if (!is_drawn(material)) continue;
        constants.textures = bind_textures(p, s, material);
        constants.material_index = range.material;
        program.set(constants);
        p.api().DrawArrays(GL_TRIANGLES, static_cast<GLint>(3 * range.first_triangle),
                           static_cast<GLsizei>(3 * range.triangle_count));
    }
}

}  // namespace ir::passes
