#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <random>

#include "renderers/scene/world.h"

namespace ir::test {

/// A scene made of a few quads or triangles, and its world. Material 0 is opaque; material 1 has an alpha
/// mask of 2 × 2 texels whose first one (u, v < 1/2) is a hole.
class SmallWorld {
  public:
    enum Material { opaque = 0, masked = 1 };

    SmallWorld() {
        scene_.name = "small";
        scene_.materials.resize(2);
        scene_.materials[masked].alpha_mode = scene::AlphaMode::mask;
        scene_.materials[masked].base_colour_texture.texture = 0;
        scene::Texture texture;
        texture.width = texture.height = 2;
        texture.rgba.assign(16, 255);
        texture.rgba[3] = 0;
        scene_.textures.push_back(texture);
        scene_.cameras.emplace_back();
    }

    /// Corners in order; uv runs from (0, 0) at a over (1, 0) at b and (1, 1) at c.
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, Material material = opaque) {
        scene::Mesh mesh;
        mesh.material = material;
        mesh.positions = {a, b, c, d};
        mesh.normals.assign(4, glm::normalize(glm::cross(b - a, d - a)));
        mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        add(std::move(mesh));
    }

    /// A square around `centre` with this normal and half a side of `half`.
    void square(glm::vec3 centre, glm::vec3 normal, float half, Material material = opaque) {
        const auto other = std::abs(normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const auto u = half * glm::normalize(glm::cross(other, normal));
        const auto v = half * glm::normalize(glm::cross(normal, u));
        quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v, material);
    }

    void add(scene::Mesh mesh) {
        scene::Node node;
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        scene_.meshes.push_back(std::move(mesh));
        scene_.nodes.push_back(node);
    }

    /// Triangles with corners at random in [-1, 1]³, those of the masked material with uv at random in [-1,
    /// 1]².
    void add_soup(int triangles, unsigned seed, Material material = opaque) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-1, 1);
        scene::Mesh mesh;
        mesh.material = material;
        for (int i = 0; i < 3 * triangles; ++i) {
            mesh.positions.emplace_back(unit(random), unit(random), unit(random));
            mesh.indices.push_back(static_cast<std::uint32_t>(i));
        }
        mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
        mesh.uv0.assign(mesh.positions.size(), {0, 0});
        if (material == masked)
            for (auto& uv : mesh.uv0) uv = {unit(random), unit(random)};
        add(std::move(mesh));
    }

    const scene::Scene& scene() const { return scene_; }
    scene::World world() const { return scene::flatten(scene_, 0, 0); }

  private:
    scene::Scene scene_;
};

/// Weights of the second and third corner at a point in a triangle's plane.
inline std::pair<double, double> barycentric(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto n = glm::cross(b - a, c - a);
    const double area = glm::dot(n, n);
    return {glm::dot(glm::cross(c - a, a - p), n) / area, glm::dot(glm::cross(b - a, p - a), n) / area};
}

/// Uniform on the sphere.
inline glm::vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

}  // namespace ir::test
