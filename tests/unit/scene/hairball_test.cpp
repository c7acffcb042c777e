#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderers/core/error.h"
#include "renderers/scene/builtin/hairball_strand.h"
#include "renderers/scene/scene.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/closed_mesh.h"

namespace ir::scene {
namespace {

using namespace testing;
namespace parts = builtin::hairball_parts;

const Scene& small() {
    static const Scene scene = make_builtin("hairball?detail=0.1");
    return scene;
}

glm::vec3 corner(const Mesh& mesh, std::size_t i) {
    return mesh.positions[mesh.indices[i]];
}

TEST(Hairball, DetailIsTheNumberOfTriangles) {
    for (const double detail : {0.02, 0.1, 0.5, 1.0, 3.0}) {
        const Scene scene = make_builtin("hairball?detail=" + std::to_string(detail));
        EXPECT_NEAR(static_cast<double>(triangles(scene)) / (detail * 200000), 1, 0.02) << detail;
    }
    EXPECT_THROW(make_builtin("hairball?detail=0.01"), UsageError);
    EXPECT_THROW(make_builtin("hairball?detail=15"), UsageError);
}

TEST(Hairball, HasTheStatedSizeUpTo2800000Triangles) {
    const Scene scene = make_builtin("hairball?detail=14");
    EXPECT_NEAR(static_cast<double>(triangles(scene)), 2.8e6, 0.01e6);
    float farthest = 0;
    glm::vec3 low(1), high(-1);
    for (const auto& p : mesh_named(scene, "hair").positions) {
        farthest = std::max(farthest, glm::length(p));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    EXPECT_LE(farthest, parts::outer_radius);
    EXPECT_GT(farthest, 0.9f * parts::outer_radius);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(high[axis] - low[axis], 0.94, 0.05) << axis;
}

TEST(Hairball, AllTubesAreClosedAndFaceOutwards) {
    for (const auto& mesh : small().meshes) {
        Edges edges;
        add_edges(edges, mesh);
        std::size_t shared = 0;
        for (const auto& [edge, count] : edges) shared += count != 1;
        EXPECT_EQ(shared, 0u) << mesh.name << ": each edge belongs to two triangles";
        EXPECT_EQ(open_edges(edges), 0u) << mesh.name;
        EXPECT_GT(volume(mesh), 0) << mesh.name;
    }
}

TEST(Hairball, NoTriangleIsDegenerateAndNormalsAreSmoothUnitVectors) {
    for (const char* name : {"hairball?detail=0.02", "hairball?detail=0.1", "hairball"})
        for (const auto& mesh : make_builtin(name).meshes) {
            std::size_t thin = 0, against = 0;
            for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
                const glm::dvec3 a = corner(mesh, i), b = corner(mesh, i + 1), c = corner(mesh, i + 2);
                const glm::dvec3 face = glm::cross(b - a, c - a);
                const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
                thin += glm::length(face) < 0.005 * longest * longest;
                glm::dvec3 shading(0);
                for (int k = 0; k < 3; ++k) shading += glm::dvec3(mesh.normals[mesh.indices[i + k]]);
                against += glm::dot(face, shading) <= 0;
            }
            EXPECT_EQ(thin, 0u) << name << " " << mesh.name;
            EXPECT_EQ(against, 0u) << name << " " << mesh.name << " of " << mesh.indices.size();
            for (const auto& n : mesh.normals) ASSERT_NEAR(glm::length(n), 1, 1e-5) << name;
        }
}

TEST(Hairball, HairsAreRootedInTheCoreAndCurl) {
    double longest_detour = 0, detours = 0;
    const int hairs = 500;
    for (int i = 0; i < hairs; ++i) {
        const parts::Strand strand(static_cast<std::uint32_t>(i));
        EXPECT_LT(glm::length(strand.at(0)) + parts::hair_radius, parts::core_radius) << i;
        double length = 0;
        for (int k = 1; k <= 200; ++k) {
            length += glm::distance(strand.at((k - 1) / 200.0f), strand.at(k / 200.0f));
            EXPECT_LE(glm::length(strand.at(k / 200.0f)) + 2 * parts::hair_radius, parts::outer_radius) << i;
        }
        const double detour = length / glm::distance(strand.at(0), strand.at(1));
        longest_detour = std::max(longest_detour, detour);
        detours += detour / hairs;
    }
    EXPECT_GT(detours, 1.5);
    EXPECT_GT(longest_detour, 2.5);
}

/// Spread evenly, however few: mean direction of roots near zero, second moments near a third.
TEST(Hairball, RootsCoverTheBallEvenly) {
    for (const int count : {64, 500, 5000}) {
        glm::dvec3 mean(0), squares(0);
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 root = glm::normalize(parts::Strand(static_cast<std::uint32_t>(i)).at(0));
            mean += root / double(count);
            squares += root * root / double(count);
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(mean[axis], 0, 4.0 / count) << count;
            EXPECT_NEAR(squares[axis], 1.0 / 3, 4.0 / count) << count;
        }
    }
}

TEST(Hairball, FewerHairsAreSomeOfMore) {
    // Equal segments: a tube of the smaller scene begins the larger one's list.
    const Scene fewer = make_builtin("hairball?detail=1"), more = make_builtin("hairball?detail=1.01");
    const Mesh &a = mesh_named(fewer, "hair"), &b = mesh_named(more, "hair");
    ASSERT_LT(a.positions.size(), b.positions.size());
    EXPECT_TRUE(std::equal(a.positions.begin(), a.positions.end(), b.positions.begin()));
    EXPECT_TRUE(std::equal(a.indices.begin(), a.indices.end(), b.indices.begin()));
}

TEST(Hairball, CamerasStandOutsideAndSeeTheBall) {
    const World world = flatten(small(), 0, 0);
    ASSERT_GE(world.cameras.size(), 2u);
    EXPECT_EQ(world.cameras[0].name, "figure9");
    for (const auto& camera : world.cameras) {
        EXPECT_GT(glm::length(camera.eye), parts::outer_radius + 0.1f) << camera.name;
        EXPECT_LT(glm::length(camera.target), parts::core_radius) << camera.name;
    }
    const float distance = glm::length(world.cameras[0].eye);
    EXPECT_GT(distance * std::sin(world.cameras[0].fov_y / 2), parts::outer_radius) << "all of it is seen";
}

}  // namespace
}  // namespace ir::scene
