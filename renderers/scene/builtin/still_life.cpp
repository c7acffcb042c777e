// Things of many materials on a table in the corner of a room, 3.8 m wide, open towards +x, +y and +z: smooth
// and rough metals, plastics, glaze, cloth and fruit, under a warm spot and a cool point light.

#include "renderers/scene/builtin/still_life.h"

#include <array>

#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin {
namespace still_life_parts {

int add_surface(Scene& scene, const std::string& name, glm::vec3 colour, float roughness, float metallic) {
    const int index = add_material(scene, name, colour, roughness);
    scene.materials[index].metallic = metallic;
    return index;
}

}  // namespace still_life_parts

namespace still_life_scene {

using namespace still_life_parts;

void add_corner(Scene& scene) {
    const glm::vec3 floor_corner{-1.6f, 0, -1.2f};
    Carving carving{{floor_corner - 0.2f, {2, 2.5f, 2}}, {{floor_corner, {3, 3, 3}}}, {}};
    enum { floor, back, side };
    carving.paint = [&](glm::vec3 middle, glm::vec3 normal) -> int {
        if (normal.y > 0.5f && middle.y < 0.01f) return floor;
        return normal.x > 0.5f && middle.x < floor_corner.x + 0.01f ? side : back;
    };
    std::array<MeshBuilder, 3> b;
    carve(b, carving);
    const int side_wall = add_textured(scene, "ochre wall", {{}, plaster()}, 1, 0.95f);
    scene.materials[side_wall].base_colour = {0.7f, 0.42f, 0.14f, 1};
    add_mesh(scene, b[floor].take("floor", add_textured(scene, "planks", planks(), 1.5f, 0.5f)));
    add_mesh(scene, b[back].take("back wall", add_surface(scene, "grey wall", {0.52f, 0.56f, 0.6f}, 0.95f)));
    add_mesh(scene, b[side].take("side wall", side_wall));
}

void add_lights(Scene& scene) {
    Light spot;
    spot.name = "spot";
    spot.type = LightType::spot;
    spot.position = {1.25f, 2.25f, 1.3f};
    spot.direction = glm::normalize(table_top - spot.position);
    spot.inner_angle = glm::radians(15.0f);
    spot.outer_angle = glm::radians(27.0f);
    spot.colour = {1, 0.9f, 0.75f};
    spot.intensity = 40;
    Light fill;
    fill.name = "fill";
    fill.position = {-1.1f, 1.9f, 0.6f};
    fill.colour = {0.6f, 0.78f, 1};
    fill.intensity = 1.8f;
    scene.lights = {spot, fill};
}

Scene make(const Values& values) {
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    add_corner(scene);
    add_table(scene, detail);
    add_fruit(scene, detail);
    add_vessels(scene, detail);
    add_shapes(scene, detail);
    add_tangents(scene);
    add_lights(scene);
    add_camera(scene, "table", {0.55f, 1.42f, 1.15f}, {-0.11f, 0.79f, -0.42f}, 40);
    add_camera(scene, "close", {0.45f, 1.0f, 0.45f}, {0.12f, 0.8f, -0.45f}, 42);
    add_camera(scene, "fruit", {-0.25f, 1.15f, 0.4f}, {-0.5f, 0.8f, -0.42f}, 40);
    add_camera(scene, "corner", {1.9f, 1.7f, 1.95f}, {-0.45f, 0.75f, -0.6f}, 48);
    return scene;
}

}  // namespace still_life_scene

Description still_life() {
    return {"still-life",
            1,
            "Metals, plastics, glaze, cloth and fruit on a table in a corner of a room (3.8 x 2.7 x 3.4 m).",
            {{"detail", 1, 0.1, 4, "", "scales the triangles of round things; 65 000 in all at 1"}},
            still_life_scene::make};
}

}  // namespace ir::scene::builtin
