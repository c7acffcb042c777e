// Which pixels are away from geometric edges.
#include "renderers/image/flat.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>

namespace ir {
namespace {

/// A picture of 40 × 30 pixels, 1 m each: the reach is one pixel.
struct Surface {
    Image normal{40, 30, 3}, position{40, 30, 3};
    Surface(const std::function<glm::vec3(int, int)>& normal_at,
            const std::function<float(int, int)>& height_at) {
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const auto n = normal_at(x, y);
                const glm::vec3 p(x, y, height_at(x, y));
                for (int c = 0; c < 3; ++c) {
                    normal.at(x, y, c) = n[c];
                    position.at(x, y, c) = p[c];
                }
            }
    }
    Image flat() const { return flat_pixels(normal, position); }
};

glm::vec3 up(int, int) {
    return {0, 0, 1};
}
float level(int, int) {
    return 0;
}

int count(const Image& image) {
    int sum = 0;
    for (const float pixel : image.pixels) sum += pixel > 0.5f;
    return sum;
}

TEST(FlatPixels, APlaneIsFlatUpToTheBorder) {
    EXPECT_EQ(count(Surface(up, level).flat()), 40 * 30);
}

TEST(FlatPixels, BothSidesOfAStepAndOfACreaseAreNot) {
    const auto step = Surface(up, [](int x, int) { return x < 20 ? 0.0f : 0.5f; }).flat();
    EXPECT_EQ(count(step), 38 * 30);
    EXPECT_EQ(step.at(19, 5), 0);
    EXPECT_EQ(step.at(20, 5), 0);
    EXPECT_EQ(step.at(18, 5), 1);
    const auto crease =
        Surface([](int x, int) { return x < 20 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0); }, level).flat();
    EXPECT_EQ(crease.at(19, 5), 0);
    EXPECT_EQ(crease.at(20, 5), 0);
    EXPECT_EQ(crease.at(18, 5), 1);
}

TEST(FlatPixels, GentleCurvesAreFlat) {
    const float radius = 40;  // one pixel turns the normal by 1.4°
    const auto slope = [&](int x) { return std::asin(float(x - 20) / radius); };
    const Surface cylinder([&](int x, int) { return glm::vec3(std::sin(slope(x)), 0, std::cos(slope(x))); },
                           [&](int x, int) { return radius * std::cos(slope(x)); });
    EXPECT_EQ(count(cylinder.flat()), 40 * 30);
}

TEST(FlatPixels, BackgroundAndWhatIsNoNumberAreNot) {
    Surface surface([](int x, int) { return x < 10 ? glm::vec3(0) : glm::vec3(0, 0, 1); }, level);
    surface.position.at(30, 15, 2) = NAN;
    EXPECT_EQ(count(surface.flat()), 29 * 30 - 9);
}

TEST(FlatPixels, TheReachGrowsWithThePicture) {
    Image normal(4, 300, 3), position(4, 300, 3);
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 4; ++x) {
            normal.at(x, y, y < 150 ? 2 : 1) = 1;
            position.at(x, y, 0) = float(x);
            position.at(x, y, y < 150 ? 1 : 2) = float(y - 150);
        }
    EXPECT_EQ(count(flat_pixels(normal, position)), 4 * (300 - 2 * 4));
}

}  // namespace
}  // namespace ir
