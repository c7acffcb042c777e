// A court with colonnades on two storeys, 30 × 18 m and 12 m high, x along its length: the scene that most
// pictures of the methods are made of. Everything solid has thickness; cloth and leaves are sheets.

#include "renderers/scene/builtin/atrium.h"

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/textures.h"

namespace ir::scene::builtin {
namespace atrium_parts {

const std::array<Side, 4>& sides() {
    static const std::array<Side, 4> all = [] {
        std::array<Side, 4> result;
        for (int i = 0; i < 4; ++i) {
            const bool is_long = i % 2 == 0;
            const float distance = is_long ? court.y : court.x;
            glm::mat4 transform = glm::rotate(glm::mat4(1), glm::radians(90.0f * i), {0, 1, 0});
            // Right angles come out exactly, so that neighbouring parts share their edges.
            for (int c = 0; c < 3; ++c)
                for (int r = 0; r < 3; ++r) transform[c][r] = std::round(transform[c][r]);
            result[i].transform = glm::translate(transform, {0, 0, distance});
            result[i].bays = is_long ? 8 : 3;
            result[i].to_wall = (is_long ? wall.y : wall.x) - distance;
            result[i].wall_half = is_long ? wall.x : wall.y;
        }
        return result;
    }();
    return all;
}

namespace {

int add_sheet(Scene& scene, const std::string& name, Texture texture, bool has_holes) {
    const int index = add_material(scene, name, glm::vec3(1), 0.95f);
    Material& material = scene.materials[index];
    material.base_colour_texture.texture = add_texture(scene, std::move(texture));
    material.double_sided = true;
    material.alpha_mode = has_holes ? AlphaMode::mask : AlphaMode::opaque;
    return index;
}

void add_lights(Scene& scene) {
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {-9.8f, 2.28f, 6.25f};
    lamp.colour = {1, 0.66f, 0.36f};
    lamp.intensity = 3;
    scene.lights = {sun({0.32f, -1, -0.42f}, 6, {1, 0.93f, 0.82f}), lamp};
    scene.environment.constant = {0.55f, 0.7f, 0.95f};
}

void add_cameras(Scene& scene) {
    add_camera(scene, "nave", {-10.1f, 1.75f, -0.9f}, {4, 3.35f, 0.35f}, 62);
    add_camera(scene, "gallery", {-10.6f, 7.35f, 6.1f}, {2.5f, 6.9f, 2.6f}, 62);
    add_camera(scene, "court", {3.4f, 1.5f, -3.2f}, {-1.6f, 4.3f, 4.4f}, 66);
    add_camera(scene, "aisle", {-12.9f, 1.7f, 6.9f}, {4, 2.35f, 5.9f}, 58);
    add_camera(scene, "balcony", {9.6f, 8.1f, 3.2f}, {-4, 3.4f, -3.2f}, 62);
    add_camera(scene, "overview", {11, 27, 21}, {0.3f, 3, -0.8f}, 44);
}

}  // namespace

Materials add_materials(Scene& scene) {
    Materials m;
    m.limestone = add_material(scene, "limestone", {0.68f, 0.6f, 0.48f}, 0.8f);
    m.plaster = add_material(scene, "plaster", {0.74f, 0.62f, 0.46f}, 0.95f);
    m.vault = add_material(scene, "vault", {0.8f, 0.74f, 0.63f}, 0.95f);
    m.bricks = add_textured(scene, "bricks", bricks(), 1.2f);
    m.tiles = add_textured(scene, "tiles", tiles(), 1.4f);
    m.paving = add_material(scene, "paving", {0.52f, 0.47f, 0.4f}, 0.85f);
    m.wood = add_material(scene, "wood", {0.3f, 0.18f, 0.1f}, 0.8f);
    m.roof = add_material(scene, "roof tiles", {0.58f, 0.25f, 0.14f}, 0.9f);
    m.iron = add_material(scene, "iron", {0.07f, 0.065f, 0.06f}, 0.6f);
    m.bronze = add_material(scene, "bronze", {0.72f, 0.48f, 0.22f}, 0.4f);
    scene.materials[m.bronze].metallic = 1;
    m.lamp = add_material(scene, "lamp glass", {0.9f, 0.8f, 0.6f}, 0.3f);
    scene.materials[m.lamp].emission = {5, 3, 1.4f};
    m.water = add_material(scene, "water", {0.06f, 0.16f, 0.18f}, 0.08f);
    m.leaf = add_sheet(scene, "leaves", leaf(), true);
    m.grille = add_sheet(scene, "grille", grille(), true);
    const glm::vec3 gold{0.66f, 0.47f, 0.16f};
    m.cloth[0] = add_sheet(scene, "red cloth", stripes("red cloth", {0.5f, 0.045f, 0.04f}, gold), false);
    m.cloth[1] = add_sheet(scene, "blue cloth", stripes("blue cloth", {0.05f, 0.12f, 0.38f}, gold), false);
    m.cloth[2] = add_sheet(scene, "green cloth", stripes("green cloth", {0.06f, 0.26f, 0.1f}, gold), false);
    return m;
}

}  // namespace atrium_parts

namespace atrium_scene {

Scene make(const Values& values) {
    using namespace atrium_parts;
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    const Materials materials = add_materials(scene);
    add_masonry(scene, materials, detail);
    add_colonnades(scene, materials, detail);
    add_roof(scene, materials, detail);
    add_drapes(scene, materials, detail);
    add_furnishings(scene, materials, detail);
    add_tangents(scene);
    add_lights(scene);
    add_cameras(scene);
    return scene;
}

}  // namespace atrium_scene

Description atrium() {
    return {"atrium",
            1,
            "A court with two storeys of colonnades, vaults, drapes and a fountain (30 x 18 x 12 m).",
            {{"detail", 1, 0.05, 4, "",
              "scales the triangles of curved surfaces; 260 000 in all at 1, 1 000 000 at 4"}},
            atrium_scene::make};
}

}  // namespace ir::scene::builtin
