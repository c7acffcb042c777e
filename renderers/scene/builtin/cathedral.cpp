// A Romanesque cathedral, 33 × 19 m and 14 m high inside: a nave of six bays with aisles, triforium and
// clerestory, ribbed vaults, an apse, and a rose window over the portal. Dense in mouldings, shafts and
// tracery, whose ambient occlusion adds up too far where every occluder counts by itself. A design of its own
// in the place of Marko Dabrovic's Sibenik cathedral, with which [Nalbach15 fig. 2] shows that; as many
// triangles.

#include "renderers/scene/builtin/cathedral.h"

#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/painting.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/textures.h"

namespace ir::scene::builtin {
namespace cathedral_parts {
namespace {

using namespace painting;

/// Courses of dressed stone in a bond, 4 × 8 on a square.
TexturePair ashlar(glm::vec3 stone) {
    struct Block {
        int column, row;
        float to_joint;
    };
    const auto block_at = [](float u, float v) {
        const float y = fraction(v) * 8;
        const int row = std::min(static_cast<int>(y), 7);
        const float x =
            fraction(u + 0.125f * static_cast<float>(row % 2) + 0.03f * static_cast<float>(row % 3)) * 4;
        const float dx = std::min(fraction(x), 1 - fraction(x)) / 4,
                    dy = std::min(fraction(y), 1 - fraction(y)) / 8;
        return Block{static_cast<int>(x), row, std::min(dx, dy)};
    };
    const auto colour = [=](float u, float v) {
        const Block block = block_at(u, v);
        const float tone = 0.86f + 0.22f * cell_random(block.column, block.row, 211);
        const float grain = 0.9f + 0.12f * noise(u, v, 22, 212) + 0.08f * noise(u, v, 90, 213);
        return glm::vec4(stone * tone * grain * (0.72f + 0.28f * smooth(0, 0.005f, block.to_joint)), 1);
    };
    const auto height = [=](float u, float v) {
        return 0.003f * smooth(0, 0.006f, block_at(u, v).to_joint) + 0.0008f * noise(u, v, 60, 214);
    };
    return {painted("ashlar", 256, colour), normals_of("ashlar normal", 256, height)};
}

void add_lights(Scene& scene) {
    scene.lights = {sun({0.34f, -0.8f, -0.46f}, 24, {1, 0.88f, 0.7f})};
    for (const int i : {0, 2, 4}) {
        Light lamp;
        lamp.name = "chandelier " + std::to_string(i / 2 + 1);
        lamp.position = {bay_middle(i), 5.35f, 0};
        lamp.colour = {1, 0.7f, 0.42f};
        lamp.intensity = 34;
        scene.lights.push_back(lamp);
    }
    Light choir;
    choir.name = "choir";
    choir.position = {nave_end - 1.2f, 6.5f, 0};
    choir.colour = {1, 0.8f, 0.55f};
    choir.intensity = 34;
    scene.lights.push_back(choir);
    scene.environment.constant = {1.5f, 1.9f, 2.5f};
}

void add_cameras(Scene& scene) {
    add_camera(scene, "nave", {-12.2f, 2.1f, -0.9f}, {2, 4.4f, 0.25f}, 62);
    add_camera(scene, "aisle", {-11.6f, 1.7f, 7.3f}, {2, 2.5f, 4.6f}, 56);
    add_camera(scene, "west", {7.9f, 3.4f, -2.2f}, {-9, 5.6f, 1.3f}, 62);
    add_camera(scene, "capital", {-1.2f, 2.6f, 1.2f}, {0.35f, 3.75f, 4.6f}, 44);
}

}  // namespace

Materials add_materials(Scene& scene) {
    Materials m;
    m.stone = add_textured(scene, "ashlar", ashlar({0.62f, 0.55f, 0.45f}), 2.4f, 0.9f);
    m.pale = add_material(scene, "limestone", {0.7f, 0.64f, 0.54f}, 0.85f);
    m.vault = add_textured(scene, "plaster", {{}, plaster()}, 2, 0.95f);
    scene.materials[m.vault].base_colour = {0.74f, 0.7f, 0.62f, 1};
    m.tiles = add_textured(scene, "tiles", tiles(), 1.8f, 0.5f);
    m.marble = add_material(scene, "grey marble", {0.42f, 0.42f, 0.43f}, 0.5f);
    m.wood =
        add_textured(scene, "oak", {wood("oak", {0.3f, 0.17f, 0.085f}, {0.18f, 0.09f, 0.04f}), {}}, 1, 0.6f);
    m.bronze = add_material(scene, "bronze", {0.72f, 0.5f, 0.25f}, 0.35f);
    scene.materials[m.bronze].metallic = 1;
    m.cloth = add_material(scene, "red cloth", {0.5f, 0.035f, 0.04f}, 0.95f);
    m.wax = add_material(scene, "wax", {0.85f, 0.8f, 0.66f}, 0.6f);
    return m;
}

}  // namespace cathedral_parts

namespace cathedral_scene {

Scene make(const Values& values) {
    using namespace cathedral_parts;
    Scene scene;
    const Detail detail{0.21f * static_cast<float>(values.at("detail")), 0.06f};
    const Materials materials = add_materials(scene);
    add_arcades(scene, materials, detail);
    add_piers(scene, materials, detail);
    add_vaults(scene, materials, detail);
    add_apse(scene, materials, detail);
    add_west_front(scene, materials, detail);
    add_furniture(scene, materials, detail);
    add_tangents(scene);
    add_lights(scene);
    add_cameras(scene);
    return scene;
}

}  // namespace cathedral_scene

Description cathedral() {
    return {"cathedral",
            1,
            "A nave with aisles, piers, ribbed vaults, apse and rose window (33 x 19 x 14 m).",
            {{"detail", 1, 0.1, 8, "",
              "scales the triangles of round things; 88 000 in all at 1, 57 000 at 0.1"}},
            cathedral_scene::make};
}

}  // namespace ir::scene::builtin
