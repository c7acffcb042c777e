// An old graveyard, 24 × 26 m, within a brick wall with a corner and an iron fence: gravestones of several
// kinds that lean and sink into uneven ground, tufts of grass blade by blade, ivy, and a bare tree. Stone,
// wood, iron and soil are closed bodies; blades, leaves and petals are sheets. A design of its own in the
// place of the graveyard with which [Nalbach15 fig. 8] shows ambient occlusion, with as many triangles.

#include "renderers/scene/builtin/graveyard.h"

#include "renderers/scene/builtin/painting.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/textures.h"

namespace ir::scene::builtin {
namespace graveyard_parts {
namespace {

using namespace painting;

constexpr double triangles_at_1 = 122000;

/// Every brick takes its tone from one of 8 × 8 cells.
TexturePair fired_clay() {
    const auto colour = [](float u, float v) {
        const int i = static_cast<int>(8 * u), j = static_cast<int>(8 * v);
        const float tone = 0.62f + 0.65f * cell_random(i, j, 71);
        const float grain = 0.8f + 0.25f * noise(u, v, 90, 73) + 0.2f * noise(u, v, 33, 74);
        const glm::vec3 clay =
            glm::mix(glm::vec3(0.42f, 0.15f, 0.085f), glm::vec3(0.46f, 0.27f, 0.16f), cell_random(i, j, 72));
        return glm::vec4(clay * tone * grain, 1);
    };
    const auto height = [](float u, float v) {
        return 0.0014f * noise(u, v, 90, 75) + 0.0012f * noise(u, v, 45, 76);
    };
    return {painted("fired clay", 256, colour), normals_of("fired clay normal", 256, height)};
}

float weathering(float u, float v) {
    return 0.5f * noise(u, v, 5, 81) + 0.3f * noise(u, v, 13, 82) + 0.2f * noise(u, v, 31, 83);
}

/// Grain, stains and lichen.
Texture weathered(const std::string& name, glm::vec3 stone, glm::vec3 stain) {
    return painted(name, 128, [=](float u, float v) {
        const float w = weathering(u, v);
        const float grain = 0.85f + 0.3f * noise(u, v, 60, 84);
        const float lichen = smooth(0.62f, 0.68f, noise(u, v, 11, 85) * 0.7f + 0.3f * noise(u, v, 37, 86));
        const glm::vec3 colour = glm::mix(stone, stain, smooth(0.45f, 0.75f, w)) * grain;
        return glm::vec4(glm::mix(colour, glm::vec3(0.47f, 0.46f, 0.27f), 0.75f * lichen), 1);
    });
}

Texture stone_relief() {
    return normals_of("stone relief", 128, [](float u, float v) {
        return 0.005f * weathering(u, v) + 0.0015f * noise(u, v, 50, 87);
    });
}

TexturePair soil() {
    const auto colour = [](float u, float v) {
        const float moss = smooth(0.3f, 0.62f, 0.6f * noise(u, v, 6, 91) + 0.4f * noise(u, v, 19, 92));
        const float grain = 0.7f + 0.6f * noise(u, v, 80, 93);
        const glm::vec3 earth(0.135f, 0.11f, 0.06f), green(0.1f, 0.135f, 0.04f);
        return glm::vec4(glm::mix(earth, green, moss) * grain, 1);
    };
    const auto height = [](float u, float v) {
        return 0.006f * noise(u, v, 24, 94) + 0.003f * noise(u, v, 60, 95);
    };
    return {painted("soil", 256, colour), normals_of("soil normal", 256, height)};
}

Texture bark() {
    return normals_of("bark relief", 128, [](float u, float v) {
        return 0.018f * noise(3 * u, v, 8, 97) + 0.01f * noise(4 * u, 2 * v, 9, 98);
    });
}

/// Darker at the foot (v = 0), each blade (u) with a tone of its own.
Texture blades(const std::string& name, glm::vec3 foot, glm::vec3 tip) {
    Texture texture = painted(name, 32, [=](float u, float v) {
        const float tone = 0.75f + 0.5f * cell_random(static_cast<int>(8 * u), 0, 99);
        return glm::vec4(glm::mix(foot, tip, v) * tone, 1);
    });
    texture.sampler.wrap_t = Wrap::clamp_to_edge;
    return texture;
}

int add_sheet(Scene& scene, const std::string& name, Texture texture) {
    const int index = add_textured(scene, name, {std::move(texture), {}}, 1, 0.9f);
    scene.materials[index].double_sided = true;
    return index;
}

int add_stone(Scene& scene, const std::string& name, glm::vec3 stone, glm::vec3 stain) {
    return add_textured(scene, name, {weathered(name, stone, stain), stone_relief()}, 0.9f, 0.9f);
}

void add_lights(Scene& scene) {
    scene.lights = {sun({0.78f, -0.62f, -0.42f}, 4.6f, {1, 0.86f, 0.66f})};
    scene.environment.constant = {0.5f, 0.62f, 0.8f};
}

void add_cameras(Scene& scene) {
    add_camera(scene, "graves", {1.3f, 1.75f, 6.2f}, {-0.52f, 0.6f, -1.2f}, 40);
    add_camera(scene, "corner", {-2.7f, 1.3f, -1.5f}, {-4.75f, 0.75f, -4.6f}, 48);
    add_camera(scene, "gate", {-0.35f, 1.25f, -0.6f}, {1.5f, 1.0f, -4.6f}, 46);
    add_camera(scene, "overview", {8.6f, 6.6f, 9.4f}, {-0.3f, 0.1f, -1.6f}, 38);
}

}  // namespace

Materials add_materials(Scene& scene) {
    Materials m;
    m.soil = add_textured(scene, "soil", soil(), 2, 0.95f);
    m.grass = add_sheet(scene, "grass", blades("grass", {0.05f, 0.1f, 0.015f}, {0.3f, 0.42f, 0.09f}));
    m.dry_grass =
        add_sheet(scene, "dry grass", blades("dry grass", {0.12f, 0.11f, 0.03f}, {0.5f, 0.42f, 0.16f}));
    m.bricks = add_textured(scene, "bricks", fired_clay(), 2, 0.9f);
    m.mortar = add_material(scene, "mortar", {0.38f, 0.34f, 0.28f}, 0.95f);
    m.iron = add_material(scene, "iron", {0.05f, 0.048f, 0.05f}, 0.5f);
    m.bark = add_textured(scene, "bark", {{}, bark()}, 0.5f, 0.95f);
    scene.materials[m.bark].base_colour = {0.17f, 0.125f, 0.09f, 1};
    m.ivy = add_sheet(scene, "ivy", blades("ivy", {0.03f, 0.09f, 0.02f}, {0.1f, 0.22f, 0.05f}));
    m.flower = add_sheet(scene, "petals", blades("petals", {0.55f, 0.1f, 0.04f}, {0.85f, 0.16f, 0.1f}));
    m.stone[0] = add_stone(scene, "granite", {0.44f, 0.44f, 0.45f}, {0.26f, 0.27f, 0.26f});
    m.stone[1] = add_stone(scene, "sandstone", {0.56f, 0.47f, 0.34f}, {0.34f, 0.29f, 0.21f});
    m.stone[2] = add_stone(scene, "slate", {0.22f, 0.24f, 0.28f}, {0.14f, 0.16f, 0.17f});
    return m;
}

}  // namespace graveyard_parts

namespace graveyard_scene {

Scene make(const Values& values) {
    using namespace graveyard_parts;
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    const Materials materials = add_materials(scene);
    add_ground(scene, materials, detail);
    add_walls(scene, materials, detail);
    add_ironwork(scene, materials, detail);
    add_gravestones(scene, materials, detail);
    add_tree(scene, materials, detail);
    add_ivy(scene, materials, detail);
    add_grass(scene, materials, static_cast<std::size_t>(values.at("detail") * triangles_at_1));
    add_tangents(scene);
    add_lights(scene);
    add_cameras(scene);
    return scene;
}

}  // namespace graveyard_scene

Description graveyard() {
    return {"graveyard",
            1,
            "Leaning gravestones, grass and a bare tree within a brick wall and an iron fence (24 x 26 m).",
            {{"detail", 1, 0.1, 8, "", "scales the triangles: 122 000 at 1, 976 000 at 8"}},
            graveyard_scene::make};
}

}  // namespace ir::scene::builtin
