// A conference room, 9 × 6 × 2.9 m, x along its length, sealed: a stand-in for the room that G. Ward
// modelled, in which photon mapping is often shown. Its light comes from spots under recessed lamps. The
// lamps' panels glow a little, too, so that they look lit: with 3 % of the spots' power, which methods that
// know only punctual lights miss; the option `emission` scales it, and 0 makes all methods see the same
// light.

#include "renderers/scene/builtin/conference.h"

#include <array>

#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin {
namespace conference_parts {

std::vector<glm::vec3> lamp_places(int count) {
    const int rows = count <= 3 ? 1 : 2, columns = (count + rows - 1) / rows;
    std::vector<glm::vec3> places;
    for (int i = 0; i < count; ++i) {
        const int column = i / rows, in_column = std::min(rows, count - column * rows);
        const float x = 7.2f * ((column + 0.5f) / columns - 0.5f);
        const float z = in_column == 1 ? 0 : 2.6f * (i % rows - 0.5f);
        places.push_back({x, room_high.y, z});
    }
    return places;
}

void add_room(Scene& scene, const Materials& m, const std::vector<glm::vec3>& lamps) {
    Carving carving{
        {room_low - wall, room_high + glm::vec3(wall, wall + recess, wall)}, {{room_low, room_high}}, {}};
    for (const auto& lamp : lamps)
        carving.holes.push_back(
            {lamp - glm::vec3(lamp_half, 0.1f, lamp_half), lamp + glm::vec3(lamp_half, recess, lamp_half)});
    for (const float x : {-2.7f, 0.0f, 2.7f})  // windows
        carving.holes.push_back(
            {{x - 0.9f, 0.95f, room_low.z - 0.12f}, {x + 0.9f, 2.35f, room_low.z + 0.1f}});
    carving.holes.push_back({{2.5f, 0, room_high.z - 0.1f}, {3.5f, 2.1f, room_high.z + 0.08f}});  // the door
    enum { walls, floor, ceiling };
    carving.paint = [](glm::vec3 middle, glm::vec3 normal) -> int {
        if (normal.y > 0.5f && middle.y < 0.01f) return floor;
        return middle.y > room_high.y - 0.01f ? ceiling : walls;
    };
    std::array<MeshBuilder, 3> b;
    carve(b, carving);
    add_mesh(scene, b[walls].take("walls", m.wall));
    add_mesh(scene, b[floor].take("floor", m.carpet));
    add_mesh(scene, b[ceiling].take("ceiling", m.ceiling));
    MeshBuilder panels;
    for (const auto& lamp : lamps)
        panels.box(lamp + glm::vec3(-lamp_half + 0.02f, recess - 0.1f, -lamp_half + 0.02f),
                   lamp + glm::vec3(lamp_half - 0.02f, recess + 0.01f, lamp_half - 0.02f));
    add_mesh(scene, panels.take("lamp panels", m.lamp));
}

}  // namespace conference_parts

namespace conference_scene {

using namespace conference_parts;

int add_wood(Scene& scene, const std::string& name, glm::vec3 light, glm::vec3 dark, float roughness) {
    return add_textured(scene, name, {wood(name, light, dark), {}}, 1.1f, roughness);
}

int add_metal(Scene& scene, const std::string& name, glm::vec3 colour, float roughness) {
    const int index = add_material(scene, name, colour, roughness);
    scene.materials[index].metallic = 1;
    return index;
}

Materials add_materials(Scene& scene, float emission) {
    Materials m;
    m.wall = add_textured(scene, "wall", {{}, plaster()}, 0.8f, 0.95f);
    scene.materials[m.wall].base_colour = {0.72f, 0.66f, 0.52f, 1};
    m.carpet = add_textured(scene, "carpet", carpet(), 0.6f, 0.98f);
    m.ceiling = add_material(scene, "ceiling", {0.8f, 0.79f, 0.76f}, 0.95f);
    m.panelling = add_wood(scene, "panelling", {0.5f, 0.31f, 0.16f}, {0.33f, 0.18f, 0.08f}, 0.5f);
    m.table = add_wood(scene, "table", {0.36f, 0.15f, 0.07f}, {0.2f, 0.07f, 0.03f}, 0.3f);
    m.door = add_wood(scene, "door", {0.58f, 0.4f, 0.22f}, {0.42f, 0.26f, 0.13f}, 0.6f);
    m.metal = add_metal(scene, "brushed steel", {0.6f, 0.6f, 0.62f}, 0.35f);
    m.black = add_material(scene, "black plastic", {0.03f, 0.03f, 0.035f}, 0.5f);
    m.pane = add_material(scene, "window pane", {0.015f, 0.02f, 0.03f}, 0.08f);
    m.blind = add_material(scene, "blinds", {0.62f, 0.65f, 0.6f}, 0.7f);
    m.board = add_material(scene, "white board", {0.85f, 0.86f, 0.86f}, 0.25f);
    m.lamp = add_material(scene, "lamp panels", {0.8f, 0.8f, 0.8f}, 0.9f);
    scene.materials[m.lamp].emission = emission * glm::vec3(1.8f, 1.68f, 1.47f);
    m.paper = add_material(scene, "paper", {0.85f, 0.84f, 0.8f}, 0.95f);
    m.china = add_material(scene, "china", {0.82f, 0.82f, 0.8f}, 0.15f);
    m.vase = add_material(scene, "vase", {0.05f, 0.16f, 0.42f}, 0.12f);
    m.leaf = add_material(scene, "shrub", {0.1f, 0.28f, 0.06f}, 0.8f);
    m.cushions[0] = add_material(scene, "red cushions", {0.52f, 0.06f, 0.05f}, 0.9f);
    m.cushions[1] = add_material(scene, "green cushions", {0.08f, 0.32f, 0.22f}, 0.9f);
    m.picture = add_textured(scene, "picture",
                             {stripes("picture", {0.66f, 0.3f, 0.08f}, {0.1f, 0.12f, 0.34f}), {}}, 0.9f);
    return m;
}

void add_lights(Scene& scene, const std::vector<glm::vec3>& lamps) {
    constexpr float total = 72;  ///< W/sr
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        Light light;
        light.name = "lamp " + std::to_string(i + 1);
        light.type = LightType::spot;
        light.position = lamps[i] - glm::vec3(0, 0.02f, 0);
        light.inner_angle = glm::radians(45.0f);
        light.outer_angle = glm::radians(75.0f);
        light.colour = {1, 0.93f, 0.82f};
        light.intensity = total / static_cast<float>(lamps.size());
        scene.lights.push_back(light);
    }
}

Scene make(const Values& values) {
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    const auto lamps = lamp_places(static_cast<int>(std::lround(values.at("lights"))));
    const Materials m = add_materials(scene, static_cast<float>(values.at("emission")));
    add_room(scene, m, lamps);
    add_fittings(scene, m, detail);
    add_furniture(scene, m, detail);
    add_tangents(scene);
    add_lights(scene, lamps);
    add_camera(scene, "table", {4.1f, 1.75f, 2.3f}, {-0.8f, 0.75f, -0.6f}, 58);
    add_camera(scene, "door", {-4.1f, 1.65f, -2.5f}, {1.2f, 0.95f, 0.9f}, 62);
    add_camera(scene, "board", {3.1f, 1.3f, 0.1f}, {-4.5f, 1.25f, -0.1f}, 52);
    add_camera(scene, "seat", {-1.2f, 1.2f, 1.35f}, {1.1f, 0.8f, -0.9f}, 60);
    return scene;
}

}  // namespace conference_scene

Description conference() {
    return {"conference",
            1,
            "A conference room with a long table, chairs and recessed lamps (9 x 6 x 2.9 m).",
            {{"detail", 1, 0.1, 4, "", "scales the triangles of rounded parts; 56 000 in all at 1"},
             {"emission", 1, 0, 1000, "", "scales the glow of the lamps' panels, 3 % of the light at 1"},
             {"lights", 4, 1, 8, "", "number of lamps, in whole numbers; together they are as bright"}},
            conference_scene::make};
}

}  // namespace ir::scene::builtin
