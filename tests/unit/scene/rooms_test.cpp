// The procedural rooms: conference, still-life and corridor.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "renderers/scene/builtin/registry.h"
#include "renderers/scene/scene.h"
#include "renderers/scene/world.h"
#include "tests/unit/scene/closed_mesh.h"

namespace ir::scene {
namespace {

using namespace testing;

/// Nearest surface to a point at `time`, in metres.
float clearance(const World& world, glm::vec3 point) {
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < world.indices.size(); i += 3)
        nearest = std::min(nearest, distance_to(point, world.positions[world.indices[i]],
                                                world.positions[world.indices[i + 1]],
                                                world.positions[world.indices[i + 2]]));
    return nearest;
}

bool is_within(glm::vec3 p, glm::vec3 low, glm::vec3 high) {
    return glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high));
}

const Scene& room(const std::string& name) {
    static std::map<std::string, Scene> scenes;
    const auto found = scenes.find(name);
    return found != scenes.end() ? found->second : scenes.emplace(name, make_builtin(name)).first->second;
}

class Rooms : public ::testing::TestWithParam<std::string> {};

/// Walls, floor and ceiling are one body in several materials.
bool is_shell(const std::string& mesh) {
    static const std::set<std::string> shells = {"walls",       "floor",      "ceiling",    "back wall",
                                                 "side wall",   "red wall",   "green wall", "blue wall",
                                                 "yellow wall", "white walls"};
    return shells.count(mesh) > 0;
}

TEST_P(Rooms, AllBodiesAreClosedAndFaceOutwards) {
    Edges shell;
    double shell_volume = 0;
    for (const auto& mesh : room(GetParam()).meshes) {
        if (is_shell(mesh.name)) {
            add_edges(shell, mesh);
            shell_volume += volume(mesh);
            continue;
        }
        EXPECT_EQ(open_edges(mesh), 0u) << mesh.name;
        EXPECT_GT(volume(mesh), 0) << mesh.name;
    }
    EXPECT_EQ(open_edges(shell), 0u);
    EXPECT_GT(shell_volume, 0);
}

TEST_P(Rooms, DetailScalesTheTriangles) {
    const std::string name = GetParam();
    const double normal = static_cast<double>(triangles(room(name)));
    const double coarse = static_cast<double>(triangles(make_builtin(name + "?detail=0.1")));
    const double fine = static_cast<double>(triangles(make_builtin(name + "?detail=4")));
    const double stated = name == "corridor" ? 14000 : name == "conference" ? 56000 : 65000;
    EXPECT_NEAR(normal / stated, 1, 0.1) << normal;
    EXPECT_LT(coarse, 0.45 * normal);
    EXPECT_GT(fine, 2.5 * normal);
}

TEST_P(Rooms, NormalMappedMeshesHaveTangents) {
    int mapped = 0;
    for (const auto& mesh : room(GetParam()).meshes) {
        if (room(GetParam()).materials[mesh.material].normal_texture.texture < 0) continue;
        ++mapped;
        EXPECT_EQ(mesh.tangents.size(), mesh.positions.size()) << mesh.name;
    }
    EXPECT_GT(mapped, 0);
}

/// Nothing stands in the camera's way, nor close to a light.
TEST_P(Rooms, CamerasAndLightsStandInTheOpen) {
    const World world = flatten(room(GetParam()), 0, 0);
    EXPECT_GE(world.cameras.size(), 3u);
    for (const auto& camera : world.cameras) EXPECT_GT(clearance(world, camera.eye), 0.15f) << camera.name;
    EXPECT_GE(world.lights.size(), 1u);
    for (const auto& light : world.lights) {
        EXPECT_TRUE(light.type == LightType::point || light.type == LightType::spot) << light.name;
        EXPECT_TRUE(is_within(light.position, world.bounds.min, world.bounds.max)) << light.name;
        EXPECT_GT(clearance(world, light.position), 0.05f) << light.name;
    }
}

INSTANTIATE_TEST_SUITE_P(, Rooms, ::testing::Values("conference", "still-life", "corridor"),
                         [](const auto& each) {
                             std::string name = each.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(Conference, HasTheStatedSizeAndLamps) {
    const Bounds bounds = bounds_of(room("conference"), 0);
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 9.4, 0.02);
    EXPECT_NEAR(bounds.max.z - bounds.min.z, 6.4, 0.02);
    double total = 0;
    for (const int count : {1, 2, 3, 4, 5, 8}) {
        const Scene scene = make_builtin("conference?lights=" + std::to_string(count));
        ASSERT_EQ(static_cast<int>(scene.lights.size()), count);
        double sum = 0;
        for (const auto& light : scene.lights) {
            sum += light.intensity;
            EXPECT_TRUE(is_within(light.position, {-4.2f, 2.8f, -2.7f}, {4.2f, 2.9f, 2.7f})) << count;
        }
        if (total == 0) total = sum;
        EXPECT_NEAR(sum, total, 1e-4 * total) << count << " lamps are as bright as one";
    }
}

TEST(Conference, PanelsGlowWithAFewPerCentOfTheSpots) {
    const Scene& scene = room("conference");
    const Mesh& panels = mesh_named(scene, "lamp panels");
    double area = 0;
    for (std::size_t i = 0; i < panels.indices.size(); i += 3) {
        const auto at = [&](int k) { return panels.positions[panels.indices[i + k]]; };
        const glm::vec3 cross = glm::cross(at(1) - at(0), at(2) - at(0));
        if (cross.y < -0.5f * glm::length(cross)) area += 0.5 * glm::length(cross);
    }
    const double glow = std::numbers::pi * area * scene.materials[panels.material].emission.r;
    double spots = 0;
    for (const auto& light : scene.lights)
        spots += 2 * std::numbers::pi * light.intensity *
                 (1 - std::cos((light.inner_angle + light.outer_angle) / 2));
    EXPECT_NEAR(glow / spots, 0.03, 0.01);
    const Scene dark = make_builtin("conference?emission=0");
    for (const auto& material : dark.materials) EXPECT_EQ(material.emission, glm::vec3(0)) << material.name;
}

TEST(StillLife, HasSmoothAndRoughMetalsAndDielectrics) {
    float roughness[2][2] = {{1, 0}, {1, 0}};  // smallest and largest of dielectrics and metals
    for (const auto& material : room("still-life").materials) {
        auto& range = roughness[material.metallic > 0.5f];
        range[0] = std::min(range[0], material.roughness);
        range[1] = std::max(range[1], material.roughness);
    }
    EXPECT_LE(roughness[0][0], 0.1f);
    EXPECT_GE(roughness[0][1], 0.9f);
    EXPECT_LE(roughness[1][0], 0.15f);
    EXPECT_GE(roughness[1][1], 0.5f);
}

TEST(StillLife, ThingsStandOnTheTable) {
    const Scene& scene = room("still-life");
    for (const char* name : {"teapot", "bottle", "candlestick", "gold ball", "rough steel ball",
                             "blue rubber ball", "copper ring", "satin chrome ball"}) {
        float low = 10;
        for (const auto& p : mesh_named(scene, name).positions) {
            low = std::min(low, p.y);
            EXPECT_TRUE(is_within(p, {-0.88f, 0.73f, -0.96f}, {0.68f, 1.2f, -0.04f})) << name;
        }
        EXPECT_NEAR(low, 0.7395, 0.0006) << name;
    }
}

TEST(Corridor, LampFliesThroughAllHallsInTime) {
    const Scene& scene = room("corridor");
    ASSERT_TRUE(scene.is_animated());
    EXPECT_FLOAT_EQ(scene.duration(), 8);
    EXPECT_FLOAT_EQ(make_builtin("corridor?seconds=3").duration(), 3);
    EXPECT_EQ(builtin::duration_of("builtin:corridor@1"), 8) << "without making it";
    EXPECT_EQ(builtin::duration_of("corridor?seconds=3"), 3);
    EXPECT_EQ(builtin::duration_of("cornell"), 0);
    std::set<int> halls;
    glm::vec3 last{0};
    for (int frame = 0; frame <= 8 * 15; ++frame) {
        const double time = frame / 15.0;
        const World world = flatten(scene, time, time);
        ASSERT_EQ(world.lights.size(), 1u);
        const glm::vec3 lamp = world.lights[0].position;
        EXPECT_TRUE(is_within(lamp, {0.3f, 1.2f, -1.8f}, {18.3f, 2.6f, 1.8f})) << time;
        // The lamp's own shade is 6.6 cm away, and nothing else is as close.
        EXPECT_NEAR(clearance(world, lamp), 0.066, 0.001) << time;
        halls.insert(static_cast<int>(lamp.x / 6.3f));
        if (frame > 0) {
            const float speed = 15 * glm::distance(lamp, last);
            EXPECT_TRUE(speed > 0.5f && speed < 4) << speed << " m/s at " << time;
        }
        last = lamp;
    }
    EXPECT_EQ(halls, (std::set<int>{0, 1, 2}));
}

TEST(Corridor, LampTakesItsShadeAlongAndMissesEverythingElse) {
    Scene scene = room("corridor");
    for (auto& node : scene.nodes)
        if (node.name == "lamp shade" || node.name == "lamp glass") node.meshes.clear();
    for (int frame = 0; frame <= 40; ++frame) {
        const World world = flatten(scene, frame / 5.0, frame / 5.0);
        EXPECT_GT(clearance(world, world.lights[0].position), 0.3f) << frame / 5.0;
    }
}

TEST(Corridor, DoorOpensBeforeTheLampPasses) {
    const Scene& scene = room("corridor");
    int node = -1;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == "door") node = static_cast<int>(i);
    ASSERT_GE(node, 0);
    const auto far_edge = [&](double time) {
        return glm::vec3(world_matrices(scene, time)[node] * glm::vec4(0, 1, 1.1f, 1));
    };
    const glm::vec3 closed = far_edge(0), open = far_edge(5.2);
    EXPECT_NEAR(closed.x, 12.58, 0.01);
    EXPECT_NEAR(closed.z, 1.31, 0.02);
    EXPECT_GT(open.x, 13.5f);
    EXPECT_LT(open.z, 0.25f);
}

}  // namespace
}  // namespace ir::scene
