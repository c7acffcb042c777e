// A closed sphere seen from within, of one albedo and one emission. With Lambertian reflection every pixel
// has the radiance emission / (1 - albedo); the accessibility is 0 everywhere. The sphere is an icosahedron
// whose triangles are split four times and pushed out, so it is convex and closed.

#include <array>
#include <cmath>
#include <map>

#include "renderers/scene/builtin/mesh_builder.h"
#include "renderers/scene/builtin/registry.h"

namespace ir::scene::builtin {
namespace furnace_scene {

using Triangle = std::array<std::uint32_t, 3>;

struct Sphere {
    std::vector<glm::vec3> points;  ///< on the unit sphere
    std::vector<Triangle> triangles;
};

Sphere icosahedron() {
    const float g = (1 + std::sqrt(5.0f)) / 2;
    Sphere sphere;
    sphere.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (auto& point : sphere.points) point = glm::normalize(point);
    sphere.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return sphere;
}

Sphere split(const Sphere& coarse) {
    Sphere fine{coarse.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = middles.emplace(std::minmax(a, b), fine.points.size());
        if (is_new) fine.points.push_back(glm::normalize(fine.points[a] + fine.points[b]));
        return found->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& part : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
            fine.triangles.push_back(part);
    }
    return fine;
}

Mesh inward_sphere(float radius, int splits) {
    Sphere sphere = icosahedron();
    for (int i = 0; i < splits; ++i) sphere = split(sphere);
    Mesh mesh;
    mesh.name = "sphere";
    for (const auto& point : sphere.points) {
        mesh.positions.push_back(radius * point);
        mesh.normals.push_back(-point);
        mesh.uv0.push_back({0.5f + 0.5f * point.x, 0.5f + 0.5f * point.y});
    }
    for (const auto& [a, b, c] : sphere.triangles) mesh.indices.insert(mesh.indices.end(), {a, c, b});
    return mesh;
}

Scene make(const Values& values) {
    Scene scene;
    const int material =
        add_material(scene, "furnace", glm::vec3(static_cast<float>(values.at("albedo"))), 1);
    scene.materials[material].emission = glm::vec3(static_cast<float>(values.at("emission")));
    const auto radius = static_cast<float>(values.at("radius"));
    add_mesh(scene, inward_sphere(radius, 4));
    add_camera(scene, "centre", {0, 0, 0}, {0, 0, -radius}, 60);
    add_camera(scene, "edge", {0, 0, 0.8f * radius}, {0, 0.3f * radius, -radius}, 90);
    return scene;
}

}  // namespace furnace_scene

Description furnace() {
    return {"furnace",
            1,
            "A closed sphere seen from within, of one albedo and emission: radiance emission / (1 - albedo).",
            {{"albedo", 0.5, 0, 1, "", "diffuse reflectance"},
             {"emission", 1, 0, 1000, "W/(m² sr)", "emitted radiance"},
             {"radius", 1, 0.01, 1000, "m", "radius of the sphere"}},
            furnace_scene::make};
}

}  // namespace ir::scene::builtin
