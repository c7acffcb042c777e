// Colourful dominoes in a winding row on a floor of metal; the first of them have fallen against each other.
// Few triangles (28 a domino, 12 the floor), and nearly all faces that the lamp shines on look away from the
// camera. A design of its own in the place of the dominoes with which [Nalbach15 fig. 8] shows indirect
// light, with as many triangles.

#include "renderers/scene/builtin/dominoes.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/plates.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace dominoes_parts {
namespace {

constexpr float spacing = 0.0196f, bevel = 0.0009f;
constexpr int fallen = 12, length_of_row = 43;

/// Straight, half a turn to the left, straight back, half a turn to the right, straight on.
Place on_the_way(float s) {
    constexpr float radius = 0.072f, first = 0.25f, second = 0.12f, turn = pi * radius;
    Place place{{-0.205f, 0.13f}, 0, 0};
    const auto go = [&](float distance) {
        place.foot += distance * glm::vec2(std::cos(place.heading), -std::sin(place.heading));
    };
    const auto bend = [&](float distance, float side) {
        const float angle = place.heading + side * distance / radius;
        const auto across = [](float a) { return glm::vec2(std::sin(a), std::cos(a)); };
        place.foot += side * radius * (across(angle) - across(place.heading));
        place.heading = angle;
    };
    const float parts[4] = {first, turn, second, turn};
    for (int i = 0; i < 4; ++i) {
        const float part = std::min(s, parts[i]);
        if (i % 2)
            bend(part, i == 1 ? 1.0f : -1.0f);
        else
            go(part);
        s -= part;
    }
    go(s);
    return place;
}

}  // namespace

float resting_angle(float distance, float next) {
    // Of the upper edge, how far it is in front of the next domino's back, less nothing where they touch.
    const auto gap = [&](float angle) {
        return (distance - height * std::sin(angle)) * std::cos(next) +
               height * std::cos(angle) * std::sin(next) - thickness;
    };
    float low = next, high = pi / 2;
    for (int i = 0; i < 40; ++i) {
        const float middle = 0.5f * (low + high);
        (gap(middle) > 0 ? low : high) = middle;
    }
    return low;
}

std::vector<Place> row() {
    std::vector<Place> places;
    for (int i = 0; i < length_of_row; ++i) places.push_back(on_the_way(spacing * static_cast<float>(i)));
    for (int i = fallen - 1; i >= 0; --i) places[i].fallen = resting_angle(spacing, places[i + 1].fallen);
    return places;
}

}  // namespace dominoes_parts

namespace dominoes_scene {

using namespace dominoes_parts;

struct Colour {
    const char* name;
    glm::vec3 value;
};
constexpr std::array<Colour, 7> colours = {{{"red", {0.72f, 0.035f, 0.03f}},
                                            {"yellow", {0.85f, 0.6f, 0.03f}},
                                            {"blue", {0.03f, 0.12f, 0.65f}},
                                            {"green", {0.06f, 0.45f, 0.08f}},
                                            {"orange", {0.85f, 0.25f, 0.02f}},
                                            {"violet", {0.3f, 0.06f, 0.5f}},
                                            {"white", {0.8f, 0.8f, 0.78f}}}};

/// A domino that stands with its lower front edge through the origin and looks along +x.
void add_domino(MeshBuilder& b, const glm::mat4& pose) {
    b.transform = glm::rotate(pose, glm::half_pi<float>(), {0, 1, 0});
    plate(b, {rectangle({-width / 2, 0}, {width / 2, height}), -thickness, 0, bevel, {0, height / 2}});
}

glm::mat4 pose_of(const Place& place) {
    // The bevel lifts a leaning domino's lowest edge.
    const float lift = bevel * std::min(std::sin(place.fallen), std::cos(place.fallen));
    glm::mat4 m = glm::translate(glm::mat4(1), {place.foot.x, -sunk - lift, place.foot.y});
    m = glm::rotate(m, place.heading, {0, 1, 0});
    return glm::rotate(m, -place.fallen, {0, 0, 1});
}

/// Loose ones: flat on the floor, upon each other, and a gate of three with one on top.
std::vector<glm::mat4> loose() {
    const auto place = [](glm::vec3 at, float turn) {
        return glm::rotate(glm::translate(glm::mat4(1), at), glm::radians(turn), {0, 1, 0});
    };
    const auto lying = [&](glm::vec3 at, float turn) {
        return glm::rotate(place(at, turn), -glm::half_pi<float>(), {0, 0, 1});
    };
    const float deck = height - sunk;
    const glm::vec3 gate(0.165f, 0, -0.05f);
    const glm::mat4 turned = place(gate, 24);
    const auto at_gate = [&](glm::mat4 m) { return turned * m; };
    return {
        at_gate(place({-0.012f, -sunk, 0}, 0)), at_gate(place({0.0225f, -sunk, 0}, 0)),
        at_gate(lying({-0.028f, deck, 0}, 0)),  at_gate(place({0.006f, deck + thickness - 2 * sunk, 0}, 90)),
        lying({0.115f, -sunk, 0.165f}, 28),     lying({0.135f, thickness - 2 * sunk, 0.16f}, 97),
        lying({-0.075f, -sunk, 0.21f}, -14)};
}

void add_dominoes(Scene& scene) {
    std::vector<glm::mat4> poses;
    for (const auto& each : row()) poses.push_back(pose_of(each));
    for (const auto& each : loose()) poses.push_back(each);
    std::array<MeshBuilder, colours.size()> b;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        // Every seventh has a colour; each round of seven begins elsewhere, so that neighbours always differ.
        const std::size_t round = i / colours.size(), step = 1 + round % 3;
        add_domino(b[(step * i + 2 * round) % colours.size()], poses[i]);
    }
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const int material = add_material(scene, colours[i].name, colours[i].value, 0.45f);
        add_mesh(scene, b[i].take(std::string(colours[i].name) + " dominoes", material));
    }
}

void add_floor(Scene& scene, float roughness) {
    MeshBuilder b;
    b.box({-1.1f, -0.02f, -1.1f}, {1.1f, 0, 1.1f});
    const int metal = add_material(scene, "metal", {0.86f, 0.87f, 0.9f}, roughness);
    scene.materials[metal].metallic = 1;
    add_mesh(scene, b.take("floor", metal));
}

void add_lights(Scene& scene) {
    Light spot;
    spot.name = "spot";
    spot.type = LightType::spot;
    spot.position = {-0.62f, 0.5f, 0.3f};
    spot.direction = glm::normalize(glm::vec3(0, 0.01f, 0.02f) - spot.position);
    spot.inner_angle = glm::radians(16.0f);
    spot.outer_angle = glm::radians(30.0f);
    spot.colour = {1, 0.95f, 0.86f};
    spot.intensity = 7;
    scene.lights = {spot};
    scene.environment.constant = {0.045f, 0.055f, 0.075f};
}

Scene make(const Values& values) {
    Scene scene;
    add_floor(scene, static_cast<float>(values.at("roughness")));
    add_dominoes(scene);
    add_lights(scene);
    add_camera(scene, "row", {0.24f, 0.25f, 0.48f}, {-0.012f, 0.008f, 0.02f}, 32);
    add_camera(scene, "gaps", {0.2f, 0.13f, 0.3f}, {-0.06f, 0.015f, 0.07f}, 30);
    add_camera(scene, "mirror", {0.12f, 0.06f, 0.42f}, {-0.01f, 0.012f, 0}, 34);
    add_camera(scene, "lamp", {-0.4f, 0.3f, 0.34f}, {-0.02f, 0, 0.01f}, 34);
    return scene;
}

}  // namespace dominoes_scene

Description dominoes() {
    return {"dominoes",
            1,
            "Colourful dominoes in a winding row on a floor of shining metal (0.5 x 0.4 m).",
            {{"roughness", 0.12, 0.02, 1, "", "of the floor"}},
            dominoes_scene::make};
}

}  // namespace ir::scene::builtin
