// Two squares of side s that meet at right angles along the z axis: the floor (y = 0, 0 ≤ x ≤ s, facing +y)
// and the wall (x = 0, 0 ≤ y ≤ s, facing +x), both with |z| ≤ s/2.
//
// The camera "wall" is orthographic and looks along -x at the wall; its height is s, so that in a square
// image of n rows the pixel row r (0 on top) shows the wall's points at the distance
//     d = s · (1 - (r + 1/2) / n)
// from the floor, and the column shows z from s/2 (left) to -s/2. There, seen from a point in the middle of
// the wall, a floor of depth s and infinite width would leave the accessibility  1 - (1 - d/√(d² + s²)) / 2.
//
// yaw, pitch and roll turn everything, cameras included, about the origin: R = Ry(yaw) Rx(pitch) Rz(roll).

#include <glm/gtc/matrix_transform.hpp>

#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace corner_scene {

glm::mat4 rotation(const Values& values) {
    const auto angle = [&](const char* key) { return glm::radians(static_cast<float>(values.at(key))); };
    glm::mat4 result = glm::rotate(glm::mat4(1), angle("yaw"), {0, 1, 0});
    result = glm::rotate(result, angle("pitch"), {1, 0, 0});
    return glm::rotate(result, angle("roll"), {0, 0, 1});
}

void rotate_camera(Camera& camera, const glm::mat4& rotation) {
    camera.eye = glm::vec3(rotation * glm::vec4(camera.eye, 1));
    camera.target = glm::vec3(rotation * glm::vec4(camera.target, 1));
    camera.up = glm::mat3(rotation) * camera.up;
}

void add_cameras(Scene& scene, float size) {
    Camera wall;
    wall.name = "wall";
    wall.eye = {size, size / 2, 0};
    wall.target = {0, size / 2, 0};
    wall.orthographic = true;
    wall.height = size;
    scene.cameras.push_back(wall);
    add_camera(scene, "view", {1.3f * size, 0.9f * size, 1.1f * size}, {0.3f * size, 0.3f * size, 0}, 45);
}

Scene make(const Values& values) {
    Scene scene;
    const auto size = static_cast<float>(values.at("size"));
    const float half = size / 2;
    MeshBuilder b;
    b.transform = rotation(values);
    b.quad({0, 0, half}, {size, 0, half}, {size, 0, -half}, {0, 0, -half});
    add_mesh(scene, b.take("floor", add_material(scene, "floor", {0.7f, 0.7f, 0.7f})));
    b.quad({0, 0, half}, {0, 0, -half}, {0, size, -half}, {0, size, half});
    add_mesh(scene, b.take("wall", add_material(scene, "wall", {0.75f, 0.45f, 0.3f})));
    add_cameras(scene, size);
    for (auto& camera : scene.cameras) rotate_camera(camera, b.transform);
    Light light;
    light.name = "lamp";
    light.position = glm::vec3(b.transform * glm::vec4(0.6f * size, 0.8f * size, 0, 1));
    light.intensity = size * size;
    scene.lights.push_back(light);
    return scene;
}

Option angle(const char* key, const char* doc) {
    return {key, 0, -360, 360, "degrees", doc};
}

}  // namespace corner_scene

Description corner() {
    return {"corner",
            1,
            "Two squares at right angles, turned as one likes.",
            {{"size", 4, 0.01, 1000, "m", "side of the squares"},
             corner_scene::angle("yaw", "turns about y, last"),
             corner_scene::angle("pitch", "turns about x, second"),
             corner_scene::angle("roll", "turns about z, first")},
            corner_scene::make};
}

}  // namespace ir::scene::builtin
