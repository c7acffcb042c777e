#include "renderers/passes/gbuffer/draw_scene.h"

#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/scene/draw_triangles.h"

namespace ir::passes {
namespace {

using graph::PassContext;

/// Constants of triangles.vert and surface.glsl.
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
    reads_triangles(pass, scene);
    reads_textures(pass, scene);
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
        draw_triangles(p, range);
    }
}

}  // namespace ir::passes
