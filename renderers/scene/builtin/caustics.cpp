// A ball of glass and a ring that is a mirror, on a table under a lamp. Both lie on the table, but for a
// tenth of a millimetre.

#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/scene/builtin/detail.h"
#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin {
namespace caustics_scene {

constexpr float gap = 1e-4f;

int glass(Scene& scene) {
    const int index = add_material(scene, "glass", glm::vec3(1), 0);
    auto& material = scene.materials[static_cast<std::size_t>(index)];
    material.transmission = material.thickness = 1;
    return index;
}

int mirror(Scene& scene) {
    const int index = add_material(scene, "mirror", {0.95f, 0.8f, 0.55f}, 0);
    scene.materials[static_cast<std::size_t>(index)].metallic = 1;
    return index;
}

Mesh ring(int material, int segments) {
    constexpr float major = 0.15f, minor = 0.035f;
    const glm::vec3 centre(0.2f, minor + gap, 0.06f);
    MeshBuilder b;
    tube(b,
         {[=](float t) { return centre + major * glm::vec3(std::cos(2 * pi * t), 0, std::sin(2 * pi * t)); },
          [](float) { return minor; },
          {0, 1, 0},
          true},
         2 * segments, segments);
    return b.take("ring", material);
}

Scene make(const Values& values) {
    Scene scene;
    const Detail detail{static_cast<float>(values.at("detail"))};
    const int segments = detail.segments(48, 8);
    MeshBuilder b;
    b.box({-0.7f, -0.04f, -0.5f}, {0.7f, 0, 0.5f});
    add_mesh(scene, b.take("table", add_material(scene, "table", {0.72f, 0.7f, 0.66f})));
    constexpr float radius = 0.11f;
    ball(b, {-0.22f, radius + gap, 0}, radius, segments);
    add_mesh(scene, b.take("ball", glass(scene)));
    add_mesh(scene, ring(mirror(scene), segments));
    Light lamp;
    lamp.name = "lamp";
    lamp.type = LightType::spot;
    lamp.position = {-0.55f, 0.6f, -0.25f};
    lamp.direction = glm::normalize(-lamp.position);
    lamp.inner_angle = glm::radians(26.0f), lamp.outer_angle = glm::radians(32.0f);
    lamp.intensity = 1;
    scene.lights.push_back(lamp);
    add_camera(scene, "table", {0.1f, 0.75f, 0.85f}, {0.02f, 0, 0}, 40);
    return scene;
}

}  // namespace caustics_scene

Description caustics() {
    return {"caustics",
            1,
            "A ball of glass and a mirror bent to a ring, on a table under a lamp.",
            {{"detail", 1, 0.05, 16, "", "scales the number of triangles"}},
            caustics_scene::make};
}

}  // namespace ir::scene::builtin
