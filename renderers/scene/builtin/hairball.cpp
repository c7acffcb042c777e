// A ball of thin curled hairs, 1 m across: thousands of tubes that grow from a small ball, each with its own
// sweep, curl and waves. Nearly everything is hidden by something, many layers lie over each other, and no
// surface is larger than a few millimetres: the opposite of architecture. A design of its own in the place of
// the hairball by Samuli Laine (NVIDIA) [Laine10], which the literature uses for the same purpose.
//
// More detail means more hairs, each of them smoother; a hair has the same path and thickness at any detail,
// and fewer hairs are some of more.

#include <algorithm>
#include <cmath>

#include "renderers/scene/builtin/hairball_strand.h"
#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/builtin/solids.h"

namespace ir::scene::builtin {
namespace hairball_scene {

using namespace hairball_parts;

constexpr double triangles_at_1 = 200000;

Segments segments_at(double detail) {
    return {std::max(16, static_cast<int>(std::lround(30 * std::pow(detail, 0.2)))),
            std::clamp(static_cast<int>(std::lround(4 * std::pow(detail, 0.1))), 3, 5)};
}

Mesh hairs(double detail, std::size_t triangles, int material) {
    const Segments segments = segments_at(detail);
    const auto count = static_cast<std::uint32_t>(std::lround(double(triangles) / segments.triangles()));
    Mesh mesh;
    mesh.name = "hair";
    mesh.material = material;
    const std::size_t vertices = std::size_t{count} * static_cast<std::size_t>(segments.vertices());
    mesh.positions.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.uv0.reserve(vertices);
    mesh.indices.reserve(std::size_t{3} * count * static_cast<std::size_t>(segments.triangles()));
    for (std::uint32_t i = 0; i < count; ++i)
        add_tube(mesh, Strand(i), segments, (static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    return mesh;
}

Scene make(const Values& values) {
    Scene scene;
    const double detail = values.at("detail");
    MeshBuilder core;
    ball(core, {0, 0, 0}, core_radius,
         std::clamp(static_cast<int>(std::lround(32 * std::sqrt(detail))), 12, 64));
    const auto left = static_cast<std::size_t>(detail * triangles_at_1) - core.triangles();
    add_mesh(scene, hairs(detail, left, add_material(scene, "hair", {0.62f, 0.4f, 0.22f}, 0.6f)));
    add_mesh(scene, core.take("core", add_material(scene, "core", {0.5f, 0.42f, 0.36f})));
    add_camera(scene, "figure9", {0.5f, 0.35f, 1.85f}, {0, 0, 0}, 32);
    add_camera(scene, "close", {0.2f, 0.16f, 0.72f}, {0, 0.03f, 0}, 40);
    scene.lights.push_back(sun({-0.5f, -0.8f, -0.6f}, 3));
    return scene;
}

}  // namespace hairball_scene

Description hairball() {
    return {"hairball",
            1,
            "A ball of thin curled hairs, 1 m across: many layers of small things.",
            {{"detail", 1, 0.02, 14, "", "scales the triangles: 200 000 at 1, 2.8 M at 14"}},
            hairball_scene::make};
}

}  // namespace ir::scene::builtin
