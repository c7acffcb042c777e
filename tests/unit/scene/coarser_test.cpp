#include "renderers/scene/coarser.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderers/scene/scene.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

double area_of(const scene::World& world) {
    double sum = 0;
    for (std::size_t t = 0; t < world.triangles(); ++t) {
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(world.positions[world.indices[3 * t + k]]);
        };
        sum += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    }
    return sum;
}

/// A sheet of n × n squares, one metre wide.
scene::Scene sheet(int n) {
    scene::Scene scene;
    scene::Mesh mesh;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            mesh.positions.emplace_back(static_cast<float>(x) / n, 0, static_cast<float>(y) / n);
    mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
    mesh.uv0.assign(mesh.positions.size(), {0, 0});
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const auto a = static_cast<std::uint32_t>(y * (n + 1) + x),
                       b = a + static_cast<std::uint32_t>(n) + 1;
            for (const auto vertex : {a, b, a + 1, a + 1, b, b + 1}) mesh.indices.push_back(vertex);
        }
    scene.materials.resize(1);
    scene::Node node;
    node.meshes = {0};
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(node);
    return scene;
}

TEST(Coarser, ASheetIsOneAlsoWithFewTriangles) {
    const auto world = scene::flatten(sheet(40), 0, 0);
    ASSERT_EQ(world.triangles(), 3200u);
    const auto coarse = scene::coarser(world, 0.1f);
    EXPECT_LE(coarse.triangles(), 330u);
    EXPECT_GT(coarse.triangles(), 0u);
    EXPECT_EQ(coarse.opaque_triangles, coarse.triangles());
    EXPECT_NEAR(area_of(coarse), 1, 1e-6);
}

TEST(Coarser, TrianglesWithCornersOfTheirOwnAreSimplifiedToo) {
    auto scene = sheet(40);
    auto& mesh = scene.meshes.front();
    std::vector<glm::vec3> corners;
    for (auto& index : mesh.indices) {
        corners.push_back(mesh.positions[index]);
        index = static_cast<std::uint32_t>(corners.size() - 1);
    }
    mesh.positions = corners;
    mesh.normals.assign(corners.size(), {0, 1, 0});
    mesh.uv0.assign(corners.size(), {0, 0});
    const auto coarse = scene::coarser(scene::flatten(scene, 0, 0), 0.1f);
    EXPECT_LE(coarse.triangles(), 330u);
    EXPECT_NEAR(area_of(coarse), 1, 1e-6);
}

TEST(Coarser, KeepsMaskedTrianglesAsTheyAre) {
    SmallWorld small;
    for (int i = 0; i < 5; ++i) small.square({0, static_cast<float>(i), 0}, {0, 1, 0}, 1, SmallWorld::masked);
    for (auto mesh : sheet(20).meshes) small.add(std::move(mesh));
    const auto world = small.world();
    ASSERT_EQ(world.triangles(), world.opaque_triangles + 10);
    const auto coarse = scene::coarser(world, 0.3f);
    EXPECT_LT(coarse.opaque_triangles, 0.4 * world.opaque_triangles);
    ASSERT_EQ(coarse.triangles(), coarse.opaque_triangles + 10);
    for (std::size_t t = 0; t < 10; ++t) {
        const auto mine = coarse.opaque_triangles + t, other = world.opaque_triangles + t;
        EXPECT_EQ(coarse.triangle_materials[mine], world.triangle_materials[other]);
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(coarse.indices[3 * mine + k], world.indices[3 * other + k]);
    }
}

TEST(Coarser, AllDetailIsTheSceneItself) {
    const auto loaded = scene::load_scene("builtin:cornell");
    const auto world = scene::flatten(loaded, 0, 0);
    EXPECT_EQ(scene::coarser(world, 1).triangles(), world.triangles());
    EXPECT_EQ(scene::coarser(scene::World(), 0.5f).triangles(), 0u);
}

}  // namespace
}  // namespace ir::test
