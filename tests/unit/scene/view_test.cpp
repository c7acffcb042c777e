#include "renderers/scene/view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderers/scene/opening_camera.h"

namespace {

using namespace ir;

const scene::Bounds bounds{{-1, -2, -3}, {4, 5, 6}};

/// Pixel position and depth of a point.
glm::vec3 projected(const scene::View& view, glm::vec3 point) {
    const auto clip = view.clip_from_world() * glm::vec4(point, 1);
    const auto ndc = glm::vec3(clip) / clip.w;
    return {(0.5f + 0.5f * ndc.x) * view.width, (0.5f - 0.5f * ndc.y) * view.height, ndc.z};
}

scene::Camera oblique(bool orthographic) {
    scene::Camera camera;
    camera.eye = {10, 7, 12};
    camera.target = {1, 1, 1};
    camera.orthographic = orthographic;
    camera.height = 8;
    return camera;
}

class ViewOfEitherKind : public testing::TestWithParam<bool> {};

TEST_P(ViewOfEitherKind, RaysGoThroughThePointsThatProjectToTheirPixel) {
    const auto view = scene::make_view(oblique(GetParam()), 320, 200, bounds);
    for (const glm::vec2 pixel : {glm::vec2(0.5f, 0.5f), glm::vec2(160, 100), glm::vec2(319.5f, 7.25f)})
        for (const float distance : {3.0f, 12.0f, 30.0f}) {
            const auto ray = scene::pixel_ray(view, pixel);
            EXPECT_NEAR(glm::length(ray.direction_ws), 1, 1e-6f);
            const auto back = projected(view, ray.origin_ws + distance * ray.direction_ws);
            EXPECT_NEAR(back.x, pixel.x, 2e-3f);
            EXPECT_NEAR(back.y, pixel.y, 2e-3f);
        }
}

TEST_P(ViewOfEitherKind, PlanesEncloseTheBounds) {
    const auto view = scene::make_view(oblique(GetParam()), 320, 200, bounds);
    float nearest = 1, farthest = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner((i & 1) ? 4 : -1, (i & 2) ? 5 : -2, (i & 4) ? 6 : -3);
        const float depth = projected(view, corner).z;
        EXPECT_GT(depth, 0);
        EXPECT_LT(depth, 1);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    EXPECT_LT(nearest, 0.1f);
    EXPECT_GT(farthest, 0.99f);
}

TEST_P(ViewOfEitherKind, TheTopRowLooksUp) {
    auto camera = oblique(GetParam());
    camera.eye = {0, 0, 20};
    camera.target = {0, 0, 0};
    const auto view = scene::make_view(camera, 100, 100, bounds);
    const auto top = scene::pixel_ray(view, {50, 0}), bottom = scene::pixel_ray(view, {50, 100});
    const auto left = scene::pixel_ray(view, {0, 50}), right = scene::pixel_ray(view, {100, 50});
    const auto at = [](const scene::Ray& ray) { return ray.origin_ws + 20.0f * ray.direction_ws; };
    EXPECT_GT(at(top).y, at(bottom).y);
    EXPECT_LT(at(left).x, at(right).x);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ViewOfEitherKind, testing::Bool(),
                         [](const auto& info) { return info.param ? "orthographic" : "perspective"; });

TEST(View, TheFieldOfViewIsVertical) {
    auto camera = oblique(false);
    camera.fov_y = 0.6f;
    const auto view = scene::make_view(camera, 640, 200, bounds);
    const auto top = scene::pixel_ray(view, {320, 0}), bottom = scene::pixel_ray(view, {320, 200});
    EXPECT_NEAR(std::acos(glm::dot(top.direction_ws, bottom.direction_ws)), 0.6f, 1e-5f);
}

TEST(View, OrthographicHeightIsInMetres) {
    const auto view = scene::make_view(oblique(true), 640, 200, bounds);
    const auto top = scene::pixel_ray(view, {320, 0}), bottom = scene::pixel_ray(view, {320, 200});
    EXPECT_NEAR(glm::length(top.origin_ws - bottom.origin_ws), 8, 1e-4f);
    EXPECT_LT(glm::length(top.direction_ws - bottom.direction_ws), 1e-6f);
}

TEST(View, InsideTheBoundsTheNearPlaneStaysInFrontOfTheEye) {
    scene::Camera camera;
    camera.eye = {1, 1, 1};
    camera.target = {1, 1, 0};
    const auto view = scene::make_view(camera, 64, 64, bounds);
    EXPECT_GT(view.near_plane, 0);
    EXPECT_LT(view.near_plane, 1e-3f * view.far_plane);
}

TEST(View, LookingAlongUpIsPossible) {
    scene::Camera camera;
    camera.eye = {0, 20, 0};
    camera.target = {0, 0, 0};
    const auto view = scene::make_view(camera, 64, 64, bounds);
    const auto ray = scene::pixel_ray(view, {32, 32});
    EXPECT_NEAR(ray.direction_ws.y, -1, 1e-5f);
}

TEST(View, TheFramingCameraSeesAllBounds) {
    const auto view = scene::make_view(scene::framing_camera(bounds), 100, 100, bounds);
    for (int i = 0; i < 8; ++i) {
        const auto p = projected(view, {(i & 1) ? 4 : -1, (i & 2) ? 5 : -2, (i & 4) ? 6 : -3});
        EXPECT_TRUE(p.x > 0 && p.x < 100 && p.y > 0 && p.y < 100) << p.x << ", " << p.y;
    }
}

}  // namespace
