// The Cornell box in metres, from the measured data of the Program of Computer Graphics, Cornell University
// (1998), turned so that its open front faces +Z: x right, y up, the back wall at z = -0.5592.
//
// The lamp is an emissive quad. Methods whose direct light comes from shadow maps see a spot light under it
// that sends the lamp's flux into its cone. Both shine together; the options scale them.

#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace cornell_scene {

/// From the published millimetres.
glm::vec3 metres(float x, float y, float z) {
    return {0.2764f - x / 1000, y / 1000, -z / 1000};
}

constexpr glm::vec3 lamp_radiance{17, 12, 4};  ///< W/(m² sr)
constexpr float lamp_width = 0.13f, lamp_depth = 0.105f;

void add_room(Scene& scene) {
    const int white = add_material(scene, "white", {0.73f, 0.73f, 0.73f});
    const int red = add_material(scene, "red", {0.63f, 0.06f, 0.05f});
    const int green = add_material(scene, "green", {0.15f, 0.48f, 0.09f});
    MeshBuilder b;
    b.quad(metres(552.8f, 0, 0), metres(0, 0, 0), metres(0, 0, 559.2f), metres(549.6f, 0, 559.2f));
    add_mesh(scene, b.take("floor", white));
    b.quad(metres(556, 548.8f, 559.2f), metres(0, 548.8f, 559.2f), metres(0, 548.8f, 0),
           metres(556, 548.8f, 0));
    add_mesh(scene, b.take("ceiling", white));
    b.quad(metres(549.6f, 0, 559.2f), metres(0, 0, 559.2f), metres(0, 548.8f, 559.2f),
           metres(556, 548.8f, 559.2f));
    add_mesh(scene, b.take("back wall", white));
    b.quad(metres(0, 0, 559.2f), metres(0, 0, 0), metres(0, 548.8f, 0), metres(0, 548.8f, 559.2f));
    add_mesh(scene, b.take("right wall", green));
    b.quad(metres(552.8f, 0, 0), metres(549.6f, 0, 559.2f), metres(556, 548.8f, 559.2f),
           metres(556, 548.8f, 0));
    add_mesh(scene, b.take("left wall", red));
}

/// A block from the corners of its published plan (x, z), clockwise there.
void add_block(Scene& scene, const std::string& name, float height, const glm::vec2 (&plan)[4]) {
    MeshBuilder b;
    const auto at = [&](int i, float y) { return metres(plan[i % 4].x, y, plan[i % 4].y); };
    b.quad(at(0, height), at(1, height), at(2, height), at(3, height));
    b.quad(at(3, 0), at(2, 0), at(1, 0), at(0, 0));
    for (int i = 0; i < 4; ++i) b.quad(at(i, 0), at(i + 1, 0), at(i + 1, height), at(i, height));
    add_mesh(scene, b.take(name, 0));
}

void add_lamp(Scene& scene, float emission) {
    const int lamp = add_material(scene, "lamp", {0.78f, 0.78f, 0.78f});
    scene.materials[lamp].emission = emission * lamp_radiance;
    const float y = 548.3f;  // half a millimetre below the ceiling
    MeshBuilder b;
    b.quad(metres(343, y, 332), metres(213, y, 332), metres(213, y, 227), metres(343, y, 227));
    add_mesh(scene, b.take("lamp", lamp));
}

void add_spot(Scene& scene, float scale) {
    if (scale == 0) return;
    Light light;
    light.name = "lamp";
    light.type = LightType::spot;
    light.position = metres(278, 538.8f, 279.5f);
    light.direction = {0, -1, 0};
    light.inner_angle = glm::radians(70.0f);
    light.outer_angle = glm::radians(85.0f);
    // Flux of the lamp over the cone in the middle of the soft edge: π L A = I · 2π (1 − cos α).
    const float cone = 2 * pi * (1 - std::cos((light.inner_angle + light.outer_angle) / 2));
    light.colour = lamp_radiance / lamp_radiance.r;
    light.intensity = scale * pi * lamp_radiance.r * lamp_width * lamp_depth / cone;
    scene.lights.push_back(light);
}

Scene make(const Values& values) {
    Scene scene;
    add_room(scene);
    add_block(scene, "short block", 165, {{130, 65}, {82, 225}, {240, 272}, {290, 114}});
    add_block(scene, "tall block", 330, {{423, 247}, {265, 296}, {314, 456}, {472, 406}});
    add_lamp(scene, static_cast<float>(values.at("emission")));
    add_spot(scene, static_cast<float>(values.at("light")));
    // The published camera: focal length 35 mm, film 25 mm.
    add_camera(scene, "front", metres(278, 273, -800), metres(278, 273, 0), 39.3077f);
    add_camera(scene, "inside", metres(500, 400, 60), metres(230, 120, 300), 60);
    add_camera(scene, "corner", metres(110, 430, 70), metres(420, 120, 430), 55);
    return scene;
}

}  // namespace cornell_scene

Description cornell() {
    return {"cornell",
            1,
            "The Cornell box (0.55 m) with its lamp as an emitter and as a spot light.",
            {{"emission", 1, 0, 1000, "", "scales the lamp's radiance"},
             {"light", 1, 0, 1000, "", "scales the spot light under the lamp; 0 leaves it out"}},
            cornell_scene::make};
}

}  // namespace ir::scene::builtin
