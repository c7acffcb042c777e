// What moves: the lamp with its light, and the door.

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/architecture.h"
#include "renderers/scene/builtin/corridor.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin::corridor_parts {
namespace {

struct Place {
    float time;
    glm::vec3 position;
};
constexpr std::array<Place, 11> flight = {{{0, {1.1f, 1.75f, 0.9f}},
                                           {1.2f, {3.1f, 2.15f, 1.05f}},
                                           {2.2f, {4.9f, 1.85f, -0.3f}},
                                           {2.9f, {6.15f, 1.6f, -0.8f}},
                                           {3.6f, {7.5f, 1.85f, -0.95f}},
                                           {4.6f, {9.4f, 2.2f, 0.1f}},
                                           {5.6f, {11.4f, 1.8f, 0.85f}},
                                           {6.1f, {12.45f, 1.55f, 0.8f}},
                                           {6.7f, {13.8f, 1.75f, 0.55f}},
                                           {7.4f, {15.3f, 2.2f, -0.2f}},
                                           {8, {16.4f, 2.1f, -0.5f}}}};

/// Through all places, with velocities that are those between their neighbours (Catmull-Rom).
AnimationChannel flight_channel(int node, float speed) {
    AnimationChannel channel{node, AnimatedPath::translation, Interpolation::cubic, {}, {}};
    for (std::size_t i = 0; i < flight.size(); ++i) {
        const Place &before = flight[i > 0 ? i - 1 : 0], &after = flight[std::min(i + 1, flight.size() - 1)];
        const glm::vec4 velocity(speed * (after.position - before.position) / (after.time - before.time), 0);
        channel.times.push_back(flight[i].time / speed);
        channel.values.insert(channel.values.end(), {velocity, glm::vec4(flight[i].position, 0), velocity});
    }
    return channel;
}

glm::vec4 turn_about_y(float degrees) {
    const float half = glm::radians(degrees) / 2;
    return {0, std::sin(half), 0, std::cos(half)};
}

int add_node(Scene& scene, const std::string& name, int parent) {
    Node node;
    node.name = name;
    node.parent = parent;
    scene.nodes.push_back(node);
    return static_cast<int>(scene.nodes.size()) - 1;
}

void add_part(Scene& scene, Mesh mesh, int parent) {
    const int node = add_node(scene, mesh.name, parent);
    scene.nodes[node].meshes = {static_cast<int>(scene.meshes.size())};
    scene.meshes.push_back(std::move(mesh));
}

}  // namespace

void add_lamp(Scene& scene, const Detail& detail, float speed) {
    const int lamp = add_node(scene, "lamp", -1), around = detail.segments(32, 10);
    scene.nodes[lamp].translation = flight.front().position;
    scene.animation.push_back(flight_channel(lamp, speed));
    // The light is at the node's origin; everything that could stand in its way lies above it.
    MeshBuilder b;
    lathe(b, {0, 0, 0},
          {{0, 0.075f},
           {0.075f, 0.075f},
           {0.08f, 0.083f},
           {0.06f, 0.125f},
           {0.018f, 0.14f},
           {0.018f, 0.16f},
           {0, 0.16f}},
          around);
    const int metal = add_material(scene, "lamp metal", {0.5f, 0.5f, 0.52f}, 0.4f);
    scene.materials[metal].metallic = 1;
    add_part(scene, b.take("lamp shade", metal), lamp);
    const int glass = add_material(scene, "lamp glass", {0.8f, 0.75f, 0.6f}, 0.5f);
    scene.materials[glass].emission = {14, 11, 7};  // 0.2 % of the light
    lathe(b, {0, 0, 0}, {{0, 0.066f}, {0.05f, 0.066f}, {0.055f, 0.078f}, {0, 0.078f}}, around);
    add_part(scene, b.take("lamp glass", glass), lamp);
    Light light;
    light.name = "lamp";
    light.colour = {1, 0.86f, 0.66f};
    light.intensity = 14;
    light.node = lamp;
    scene.lights.push_back(light);
}

void add_door(Scene& scene, const Detail& detail, float speed) {
    const Doorway& doorway = doorways[1];
    const int hinge = add_node(scene, "hinge", -1);
    scene.nodes[hinge].translation = {hall_start(2) - 0.02f, 0, doorway.low_z + 0.012f};
    // Closed along z; turned by 90° it stands along x in the last hall.
    scene.animation.push_back({hinge,
                               AnimatedPath::rotation,
                               Interpolation::linear,
                               {0, 3.4f / speed, 5.0f / speed, duration / speed},
                               {turn_about_y(0), turn_about_y(0), turn_about_y(96), turn_about_y(96)}});
    MeshBuilder b;
    const float width = doorway.high_z - doorway.low_z - 0.02f;
    b.box({-0.045f, 0.012f, 0}, {0, doorway.height - 0.012f, width});
    for (const float y : {0.15f, 1.15f}) b.box({-0.053f, y, 0.16f}, {0.008f, y + 0.8f, width - 0.16f});
    add_part(scene, b.take("door", add_material(scene, "door", {0.32f, 0.2f, 0.12f}, 0.6f)), hinge);
    for (const float side : {-1.0f, 1.0f}) {
        const float from = side < 0 ? -0.045f : 0;
        const glm::vec3 at(from, 1.05f, width - 0.07f), out(side * 0.05f, 0, 0);
        bar(b, at - 0.3f * out, at + out, 0.01f, detail.segments(12, 6));
        bar(b, at + 0.9f * out + glm::vec3(0, 0, 0.005f), at + 0.9f * out - glm::vec3(0, 0, 0.12f), 0.01f,
            detail.segments(12, 6));
    }
    add_part(scene, b.take("door handles", static_cast<int>(scene.meshes[scene.meshes.size() - 3].material)),
             hinge);
}

}  // namespace ir::scene::builtin::corridor_parts
