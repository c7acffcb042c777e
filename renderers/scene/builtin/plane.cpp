// One square plane y = 0 around the origin, facing up: nothing occludes it, so its accessibility is 1. With
// `cover` an equal plane faces it from `cover` metres above. At the middle of the lower plane only directions
// below the cover's border stay open; with half side a and height h the accessibility there is
//     1 - F,  F = 4/π · k · atan(k),  k = a / √(a² + h²)
// (form factor of a centred parallel square), which tends to 0 as h → 0.

#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace plane_scene {

void add_cover(Scene& scene, float half, float height) {
    MeshBuilder b;
    b.quad({-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half});
    add_mesh(scene, b.take("cover", add_material(scene, "cover", {0.6f, 0.65f, 0.75f})));
    // Between the planes, straight down: the middle half of the lower plane, a quarter of its side from the
    // border. Nothing behind the eye is seen.
    Camera under;
    under.name = "under";
    under.eye = {0, 0.5f * height, 0};
    under.up = {0, 0, -1};
    under.orthographic = true;
    under.height = half;
    scene.cameras.push_back(under);
}

Scene make(const Values& values) {
    Scene scene;
    const float half = static_cast<float>(values.at("size")) / 2;
    const auto cover = static_cast<float>(values.at("cover"));
    MeshBuilder b;
    b.quad({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half});
    add_mesh(scene, b.take("plane", add_material(scene, "plane", {0.7f, 0.7f, 0.7f})));
    add_camera(scene, "above", {0, 0.6f * half, 1.1f * half}, {0, 0, 0}, 45);
    Camera top;
    top.name = "top";
    top.eye = {0, half, 0};
    top.up = {0, 0, -1};
    top.orthographic = true;
    top.height = 2 * half;
    scene.cameras.push_back(top);
    if (cover > 0) add_cover(scene, half, cover);
    Light light;
    light.name = "lamp";
    light.position = {0, cover > 0 ? 0.9f * cover : 0.5f * half, 0};
    light.intensity = light.position.y * light.position.y;  // 1 W/m² below it
    scene.lights.push_back(light);
    return scene;
}

}  // namespace plane_scene

Description plane() {
    return {"plane",
            1,
            "A square plane, and on demand a second one above it.",
            {{"size", 10, 0.01, 1000, "m", "side of the square"},
             {"cover", 0, 0, 1000, "m", "height of a second plane; 0 leaves it out"}},
            plane_scene::make};
}

}  // namespace ir::scene::builtin
