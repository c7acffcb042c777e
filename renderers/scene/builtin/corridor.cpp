// Three dark halls of 6 × 4 × 3.2 m in a row along x, sealed, with a doorway in each wall between them. A
// lamp flies through all of them within eight seconds, and opens a door on its way: nothing else shines, so
// that what is lit at all behind a corner is lit by the coloured walls.

#include "renderers/scene/builtin/corridor.h"

#include <array>

#include "renderers/scene/builtin/interior_textures.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin {
namespace corridor_parts {
namespace {

enum Surface { white, red, green, blue, yellow, floor_tiles, ceiling };

/// The colour of a face that looks into a hall.
int surface_at(glm::vec3 middle, glm::vec3 normal) {
    if (normal.y > 0.5f && middle.y < 0.01f) return floor_tiles;
    if (normal.y < -0.5f && middle.y > hall_height - 0.01f) return ceiling;
    const bool is_first = middle.x<hall_start(1), is_last = middle.x> hall_start(2);
    if (normal.z < -0.5f && middle.z > hall_half - 0.01f) return is_first ? red : is_last ? yellow : white;
    if (normal.z > 0.5f && middle.z < 0.01f - hall_half) return is_first || is_last ? white : green;
    return normal.x < -0.5f && middle.x > hall_start(3) - wall - 0.01f ? blue : white;
}

}  // namespace

void add_halls(Scene& scene) {
    Carving carving{
        {{-wall, -wall, -hall_half - wall}, {hall_start(3), hall_height + wall, hall_half + wall}}, {}, {}};
    for (int i = 0; i < 3; ++i)
        carving.holes.push_back(
            {{hall_start(i), 0, -hall_half}, {hall_start(i) + hall_length, hall_height, hall_half}});
    for (const auto& d : doorways)
        carving.holes.push_back({{hall_start(d.hall) + hall_length - 0.1f, 0, d.low_z},
                                 {hall_start(d.hall + 1) + 0.1f, d.height, d.high_z}});
    carving.paint = surface_at;
    std::array<MeshBuilder, 7> b;
    carve(b, carving);
    const int rough = add_textured(scene, "white plaster", {{}, plaster()}, 1, 0.95f);
    scene.materials[rough].base_colour = {0.72f, 0.71f, 0.68f, 1};
    add_mesh(scene, b[white].take("white walls", rough));
    add_mesh(scene, b[red].take("red wall", add_material(scene, "red paint", {0.6f, 0.06f, 0.04f})));
    add_mesh(scene, b[green].take("green wall", add_material(scene, "green paint", {0.08f, 0.45f, 0.1f})));
    add_mesh(scene, b[blue].take("blue wall", add_material(scene, "blue paint", {0.06f, 0.14f, 0.55f})));
    add_mesh(scene, b[yellow].take("yellow wall", add_material(scene, "yellow paint", {0.7f, 0.52f, 0.07f})));
    add_mesh(scene, b[floor_tiles].take("floor", add_textured(scene, "tiles", tiles(), 1.6f, 0.6f)));
    add_mesh(scene, b[ceiling].take("ceiling", add_material(scene, "ceiling", {0.66f, 0.66f, 0.66f}, 0.95f)));
}

}  // namespace corridor_parts

namespace corridor_scene {

using namespace corridor_parts;

Scene make(const Values& values) {
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    const float speed = duration / static_cast<float>(values.at("seconds"));
    add_halls(scene);
    add_things(scene, detail);
    add_lamp(scene, detail, speed);
    add_door(scene, detail, speed);
    add_tangents(scene);
    add_camera(scene, "entrance", {0.35f, 1.65f, -0.25f}, {5.4f, 1.25f, -0.15f}, 66);
    add_camera(scene, "middle", {6.7f, 1.75f, -0.45f}, {11.9f, 1.15f, 0.05f}, 66);
    add_camera(scene, "end", {18.1f, 1.75f, -1.6f}, {13.1f, 1.15f, 0.5f}, 64);
    return scene;
}

}  // namespace corridor_scene

Description corridor() {
    return {"corridor",
            1,
            "Three dark halls with doorways, through which a lamp flies (19 x 3.2 x 4 m, 8 s).",
            {{"detail", 1, 0.1, 4, "", "scales the triangles of round things; 14 000 in all at 1"},
             {"seconds", 8, 1, 60, "s", "how long the flight takes"}},
            corridor_scene::make,
            [](const Values& values) { return values.at("seconds"); }};
}

}  // namespace ir::scene::builtin
