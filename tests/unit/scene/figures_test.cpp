// The procedural scenes that stand for those of published figures: graveyard, dominoes, cathedral and
// caustics.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "renderers/core/error.h"
#include "renderers/scene/builtin/dominoes.h"
#include "renderers/scene/scene.h"
#include "tests/unit/scene/closed_mesh.h"
#include "tests/unit/scene/first_hit.h"

namespace ir::scene {
namespace {

using namespace testing;

const Scene& scene_of(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(name);
    return found != scenes.end() ? found->second : scenes.emplace(name, make_builtin(name)).first->second;
}

class Figures : public ::testing::TestWithParam<std::string> {};

TEST_P(Figures, NoTriangleIsDegenerate) {
    for (const auto& mesh : scene_of(GetParam()).meshes) {
        std::size_t thin = 0;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](int k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
            thin += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) < 1e-10;
        }
        EXPECT_EQ(thin, 0u) << mesh.name;
    }
}

TEST_P(Figures, NormalMappedMeshesHaveTangents) {
    int found = 0;
    for (const auto& mesh : scene_of(GetParam()).meshes) {
        if (scene_of(GetParam()).materials[mesh.material].normal_texture.texture < 0) continue;
        ++found;
        EXPECT_EQ(mesh.tangents.size(), mesh.positions.size()) << mesh.name;
    }
    EXPECT_EQ(found > 0, GetParam() != "dominoes") << "dominoes are smooth";
}

TEST_P(Figures, CamerasStandInTheOpenAndSeeSurfaces) {
    const Scene& scene = scene_of(GetParam());
    EXPECT_GE(scene.cameras.size(), 4u);
    const float size = bounds_of(scene, 0).radius();
    for (const auto& camera : scene.cameras) {
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up)),
                        up = glm::cross(right, forward);
        const float half = std::tan(camera.fov_y / 2);
        int seen = 0;
        for (const float x : {-1.3f, 0.02f, 1.3f})
            for (const float y : {-0.8f, -0.4f, 0.01f}) {
                const float distance =
                    first_hit(scene, camera.eye, glm::normalize(forward + half * (x * right + y * up)));
                EXPECT_GT(distance, 0.01f * size) << camera.name;
                seen += std::isfinite(distance);
            }
        EXPECT_GE(seen, 6) << camera.name;
    }
}

INSTANTIATE_TEST_SUITE_P(, Figures,
                         ::testing::Values("graveyard?detail=0.1", "dominoes", "cathedral?detail=0.1"),
                         [](const auto& each) { return each.param.substr(0, each.param.find('?')); });

TEST(Graveyard, HasAsManyTrianglesAsThePublishedOne) {
    EXPECT_NEAR(static_cast<double>(triangles(scene_of("graveyard"))), 122000, 3);
    EXPECT_NEAR(static_cast<double>(triangles(make_builtin("graveyard?detail=3"))), 366000, 3);
    EXPECT_LT(triangles(scene_of("graveyard?detail=0.1")), 14000u);
    EXPECT_THROW(make_builtin("graveyard?detail=0.05"), UsageError);
    EXPECT_THROW(make_builtin("graveyard?detail=9"), UsageError);
}

TEST(Graveyard, BodiesAreClosedAndBladesAreSheets) {
    const std::set<std::string> sheets = {"grass", "dry grass", "ivy", "flowers"};
    for (const char* name : {"graveyard", "graveyard?detail=0.1"})
        for (const auto& mesh : scene_of(name).meshes) {
            const bool is_sheet = sheets.count(mesh.name) > 0;
            EXPECT_EQ(scene_of(name).materials[mesh.material].double_sided, is_sheet) << mesh.name;
            if (is_sheet) continue;
            EXPECT_EQ(open_edges(mesh), 0u) << name << " " << mesh.name;
            EXPECT_GT(volume(mesh), 0) << name << " " << mesh.name;
        }
}

/// What makes the wall's subtle shadows: no two bricks stand out equally far.
TEST(Graveyard, BricksStandOutByDifferentMillimetres) {
    std::set<long> depths;
    float low = 1e9f, high = -1e9f;
    for (const auto& p : mesh_named(scene_of("graveyard"), "bricks").positions) {
        if (p.x < -4.5f || p.x > -1 || p.z < -4.62f || p.z > -4.4f) continue;  // inner face of the back wall
        low = std::min(low, p.z);
        high = std::max(high, p.z);
        depths.insert(std::lround(p.z * 1e4));
    }
    EXPECT_GT(depths.size(), 100u);
    EXPECT_NEAR(high - low, 0.024f, 0.006f) << "metres";
}

TEST(Dominoes, AreAboutAsManyTrianglesAsPublishedAllClosed) {
    const Scene& scene = scene_of("dominoes");
    EXPECT_EQ(triangles(scene), 50u * 28 + 12);
    for (const auto& mesh : scene.meshes) {
        EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
        EXPECT_GT(volume(mesh), 0) << mesh.name;
    }
    EXPECT_FLOAT_EQ(scene.materials[mesh_named(scene, "floor").material].metallic, 1);
    const Scene rough = make_builtin("dominoes?roughness=0.3");
    EXPECT_FLOAT_EQ(rough.materials[mesh_named(rough, "floor").material].roughness, 0.3f);
    EXPECT_NE(rough.content_hash, scene.content_hash);
    EXPECT_THROW(make_builtin("dominoes?roughness=0"), UsageError);
}

TEST(CausticsScene, HasClosedBodiesOfGlassAndMirrorOnATable) {
    const Scene& scene = scene_of("caustics");
    for (const auto& mesh : scene.meshes) {
        EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
        EXPECT_GT(volume(mesh), 0) << mesh.name;
        float low = 1;
        for (const auto& p : mesh.positions) low = std::min(low, p.y);
        EXPECT_NEAR(low, mesh.name == "table" ? -0.04f : 0, 1e-3f) << mesh.name;
    }
    const auto& glass = scene.materials[mesh_named(scene, "ball").material];
    EXPECT_GT(glass.thickness, 0) << "it bends light";
    EXPECT_FLOAT_EQ(glass.transmission, 1);
    const auto& mirror = scene.materials[mesh_named(scene, "ring").material];
    EXPECT_FLOAT_EQ(mirror.metallic, 1);
    EXPECT_FLOAT_EQ(glass.roughness + mirror.roughness, 0);
    EXPECT_GT(triangles(scene), 4 * triangles(make_builtin("caustics?detail=0.1")));
}

/// The upper front edge of a fallen domino lies on the back of the next one, to a hundredth of a millimetre.
TEST(Dominoes, FallenOnesRestOnTheirNeighbours) {
    using namespace builtin::dominoes_parts;
    const auto places = row();
    ASSERT_GT(places.size(), 30u);
    int fallen = 0;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        EXPECT_GE(places[i].fallen, places[i + 1].fallen);
        if (places[i].fallen == 0) continue;
        ++fallen;
        const float distance = glm::distance(places[i].foot, places[i + 1].foot);
        const float a = places[i].fallen, b = places[i + 1].fallen;
        const glm::vec2 edge(height * std::sin(a), height * std::cos(a));
        const glm::vec2 out(-std::cos(b), std::sin(b));  // of the next one's back
        EXPECT_NEAR(glm::dot(edge - glm::vec2(distance, 0), out), thickness, 1e-5f) << i;
    }
    EXPECT_GE(fallen, 8);
    EXPECT_GT(places.front().fallen, 0.7f);
}

TEST(Dominoes, StandOnTheFloor) {
    for (const auto& mesh : scene_of("dominoes").meshes) {
        if (mesh.name == "floor") continue;
        float low = 1;
        for (const auto& p : mesh.positions) low = std::min(low, p.y);
        EXPECT_NEAR(low, -builtin::dominoes_parts::sunk, 1e-5f) << mesh.name;
    }
}

TEST(Cathedral, HasTheStatedSizeAndDetailScales) {
    const double normal = static_cast<double>(triangles(scene_of("cathedral")));
    EXPECT_GT(normal, 60000);
    EXPECT_LT(normal, 90000);
    EXPECT_LT(static_cast<double>(triangles(scene_of("cathedral?detail=0.1"))), 0.7 * normal);
    EXPECT_GT(static_cast<double>(triangles(make_builtin("cathedral?detail=4"))), 1.7 * normal);
    const Bounds bounds = bounds_of(scene_of("cathedral"), 0);
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 34, 1.5);
    EXPECT_NEAR(bounds.max.y, 13.6, 0.2);
    EXPECT_NEAR(bounds.max.z - bounds.min.z, 19, 0.2);
}

TEST(Cathedral, VaultsMouldingsAndFurnitureAreClosed) {
    // Walls are panels side by side whose ends are hidden in piers.
    const std::set<std::string> panels = {"walls", "apse walls", "west front"};
    for (const char* name : {"cathedral", "cathedral?detail=0.1"})
        for (const auto& mesh : scene_of(name).meshes) {
            if (panels.count(mesh.name)) continue;
            EXPECT_EQ(open_edges(mesh), 0u) << name << " " << mesh.name;
            EXPECT_GT(volume(mesh), 0) << name << " " << mesh.name;
        }
}

/// No light comes in but through windows.
TEST(Cathedral, VaultsCoverNaveAislesAndApse) {
    const Scene& scene = scene_of("cathedral?detail=0.1");
    for (int i = 0; i < 40; ++i)
        for (const float z : {-6.77f, -3.31f, -0.13f, 2.57f, 7.91f}) {
            const float x = -13.3f + 0.66f * static_cast<float>(i) + 0.011f * z;
            EXPECT_LT(first_hit(scene, {x, 3.4f, z}, {0, 1, 0}), 11) << x << " " << z;
        }
    for (const float x : {13.9f, 15.1f, 16.4f})
        EXPECT_LT(first_hit(scene, {x, 3.4f, 0.21f}, {0, 1, 0}), 11) << x;
}

}  // namespace
}  // namespace ir::scene
