#include "renderers/scene/opening_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "renderers/passes/raytracing/bvh.h"
#include "renderers/scene/view.h"

/// Where a scene without a camera is seen from, judged by exact rays.
namespace ir {
namespace {

struct Case {
    std::string scene;   ///< builtin:NAME, or a file or folder in INTERREFLECT_SCENES
    double min_seen;     ///< part of all surface that the picture shows, with what is seen from nowhere
    double min_covered;  ///< part of the picture that shows a surface
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.scene;
}

/// The path, or nothing where the scene is not here.
std::string path_of(const std::string& name) {
    if (name.rfind("builtin:", 0) == 0) return name;
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return {};
    const auto path = std::filesystem::path(folder) / name;
    return std::filesystem::exists(path) ? path.string() : std::string();
}

class OpeningCamera : public testing::TestWithParam<Case> {
  protected:
    void SetUp() override {
        const auto path = path_of(GetParam().scene);
        if (path.empty()) GTEST_SKIP() << GetParam().scene << " is not in INTERREFLECT_SCENES";
        scene_ = scene::load_scene(path);
        scene_.cameras = {scene::opening_camera(scene_)};
        world_ = scene::flatten(scene_, 0, 0);
        bvh_ = std::make_unique<passes::Bvh>(scene_, world_);
        view_ = scene::make_view(camera(), 48, 32, world_.bounds);
    }

    const scene::Camera& camera() const { return scene_.cameras.front(); }
    float extent() const { return 2 * world_.bounds.radius(); }

    /// Distances of the picture's pixels; infinite where nothing is seen.
    std::vector<float> distances() const {
        std::vector<float> result;
        for (int y = 0; y < view_.height; ++y)
            for (int x = 0; x < view_.width; ++x) {
                const auto ray = scene::pixel_ray(view_, {x + 0.5f, y + 0.5f});
                result.push_back(bvh_->closest(ray.origin_ws, ray.direction_ws, 0, 1e9f));
            }
        return result;
    }

    double covered() const {
        const auto all = distances();
        return double(std::count_if(all.begin(), all.end(), [](float d) { return d < 1e9f; })) / all.size();
    }

    /// The part of all surface, by area, that the picture shows.
    double seen() const {
        std::vector<double> areas;
        for (std::size_t t = 0; t < world_.triangles(); ++t) {
            const auto [a, b, c] = corners(t);
            areas.push_back(glm::length(glm::cross(b - a, c - a)));
        }
        std::mt19937 random(1);
        std::discrete_distribution<std::size_t> triangle(areas.begin(), areas.end());
        std::uniform_real_distribution<float> unit(0, 1);
        constexpr int points = 4000;
        int count = 0;
        for (int i = 0; i < points; ++i) {
            const auto [a, b, c] = corners(triangle(random));
            float u = unit(random), v = unit(random);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            count += is_seen(a + u * (b - a) + v * (c - a));
        }
        return double(count) / points;
    }

    scene::Scene scene_;
    scene::World world_;
    std::unique_ptr<passes::Bvh> bvh_;
    scene::View view_;

  private:
    std::array<glm::vec3, 3> corners(std::size_t triangle) const {
        const auto* i = &world_.indices[3 * triangle];
        return {world_.positions[i[0]], world_.positions[i[1]], world_.positions[i[2]]};
    }

    bool is_seen(glm::vec3 point) const {
        const auto clip = view_.clip_from_world() * glm::vec4(point, 1);
        if (clip.w <= 0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) return false;
        const auto way = point - view_.eye_ws;
        const float distance = glm::length(way);
        return !bvh_->occluded(view_.eye_ws, way / distance, 0, distance - 1e-3f * extent());
    }
};

using OfARoom = OpeningCamera;

TEST_P(OfARoom, StandsFreeInItAndSeesMuchOfIt) {
    const auto& bounds = world_.bounds;
    EXPECT_TRUE(glm::all(glm::greaterThan(camera().eye, bounds.min - 0.6f * extent())) &&
                glm::all(glm::lessThan(camera().eye, bounds.max + 0.6f * extent())));
    std::mt19937 random(2);
    std::normal_distribution<float> normal;
    int level = 0, ends = 0;
    float nearest = 1e9f;
    for (int i = 0; i < 2000; ++i) {
        const auto direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const float distance = bvh_->closest(camera().eye, direction, 0, 1e9f);
        nearest = std::min(nearest, distance);
        if (std::abs(direction.y) > 0.4f) continue;
        ++level;
        ends += distance < 1e9f;
    }
    EXPECT_GT(nearest, 0.005f * extent()) << "in a wall";
    const bool is_inside = glm::all(glm::greaterThan(camera().eye, bounds.min)) &&
                           glm::all(glm::lessThan(camera().eye, bounds.max));
    EXPECT_GT(is_inside ? double(ends) / level : 1.0, 0.55) << "outside of the room";
    EXPECT_GE(covered(), GetParam().min_covered);
    EXPECT_GE(seen(), GetParam().min_seen);
}

TEST_P(OfARoom, IsTheSameEachTime) {
    const auto again = scene::opening_camera(scene_);
    EXPECT_EQ(again.eye, camera().eye);
    EXPECT_EQ(again.target, camera().target);
}

INSTANTIATE_TEST_SUITE_P(Builtin, OfARoom,
                         testing::Values(Case{"builtin:atrium", 0.03, 0.85},
                                         Case{"builtin:conference", 0.07, 0.95},
                                         Case{"builtin:cathedral", 0.04, 0.95},
                                         Case{"builtin:corridor", 0.03, 0.95},
                                         Case{"builtin:still-life", 0.07, 0.8}));
INSTANTIATE_TEST_SUITE_P(Shared, OfARoom,
                         testing::Values(Case{"sponza.glb", 0.014, 0.85}, Case{"conference.glb", 0.1, 0.95},
                                         Case{"cornell/CornellBox-Original.glb", 0.2, 0.85},
                                         Case{"cornell/CornellBox-Sphere.glb", 0.2, 0.85},
                                         Case{"rooms/living-room/living-room.glb", 0.05, 0.85},
                                         Case{"rooms/staircase2/staircase2.glb", 0.05, 0.85}));

using OfAThing = OpeningCamera;

TEST_P(OfAThing, SeesAllOfItFromOutsideAndFillsThePicture) {
    EXPECT_GE(covered(), GetParam().min_covered);
    EXPECT_GE(seen(), GetParam().min_seen);
    const auto& bounds = world_.bounds;
    EXPECT_TRUE(glm::any(glm::lessThan(camera().eye, bounds.min)) ||
                glm::any(glm::greaterThan(camera().eye, bounds.max)));
    const auto all = distances();
    for (int x = 0; x < view_.width; ++x) {
        EXPECT_GT(all[std::size_t(x)], 1e9f) << "cut at the top";
        EXPECT_GT(all[std::size_t((view_.height - 1) * view_.width + x)], 1e9f) << "cut at the bottom";
    }
}

INSTANTIATE_TEST_SUITE_P(Builtin, OfAThing,
                         testing::Values(Case{"builtin:hairball", 0.05, 0.1},
                                         Case{"builtin:dominoes", 0.3, 0.05}));
INSTANTIATE_TEST_SUITE_P(Shared, OfAThing,
                         testing::Values(Case{"stanford-bunny.glb", 0.3, 0.12}, Case{"teapot.glb", 0.1, 0.1},
                                         Case{"dragon.glb", 0.2, 0.06}, Case{"spot.glb", 0.3, 0.08},
                                         Case{"gltf-samples/DamagedHelmet/glTF/DamagedHelmet.gltf", 0.1,
                                              0.12}));

TEST(OpeningCameraOfNothing, IsStillACamera) {
    scene::Scene scene;
    scene.materials.resize(1);
    const auto camera = scene::opening_camera(scene);
    EXPECT_GT(glm::length(camera.target - camera.eye), 0);
}

}  // namespace
}  // namespace ir
