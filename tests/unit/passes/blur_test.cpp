// The geometry-aware blur: what it leaves alone, what it does not cross, and how much noise it takes away.
#include <cmath>
#include <random>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/blur/blur.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

class BlurTest : public PassTest {
  protected:
    /// Blurs a picture of the view's size that `value(x, y, channel)` gives.
    Image blurred(const Shot& shot, const passes::BlurParameters& options,
                  const std::function<float(int, int, int)>& value, gl::Format format = gl::Format::r32f) {
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto gbuffer = passes::gbuffer(builder, passes::upload_scene(builder));
            graph::ImageDesc desc;
            desc.text = {"given", "Given"};
            desc.format = format;
            const auto given = builder.image(desc);
            const int channels = format == gl::Format::r32f ? 1 : format == gl::Format::rg32f ? 2 : 4;
            const int width = shot.view.width, height = shot.view.height;
            builder.pass("give").writes(given).execute([=](graph::PassContext& context) {
                std::vector<float> texels;
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x)
                        for (int c = 0; c < channels; ++c) texels.push_back(value(x, y, c));
                context.upload(given, std::as_bytes(std::span(texels)));
            });
            passes::blur(builder, gbuffer, given, options, {"blurred", "Blurred"});
        });
        return read("blurred");
    }
    Shot plane() { return {"builtin:plane", "top", 48, 48}; }
    Shot tilted_plane() { return {"builtin:plane", "above", 64, 64}; }
};

scene::Camera from_above(float height) {
    scene::Camera camera;
    camera.eye = {0, 3, 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.orthographic = true;
    camera.height = height;
    return camera;
}

TEST_F(BlurTest, AConstantStaysTheSameToTheBit) {
    for (const auto format : {gl::Format::r32f, gl::Format::rg32f, gl::Format::rgba32f})
        for (const auto& shot : {plane(), tilted_plane(), Shot("builtin:corner", "view", 48, 48)}) {
            const auto image = blurred(
                shot, {.radius = 6}, [](int, int, int c) { return 0.1f + 0.3f * static_cast<float>(c); },
                format);
            for (int c = 0; c < image.channels; ++c)
                for (int y = 0; y < image.height; ++y)
                    for (int x = 0; x < image.width; ++x)
                        ASSERT_EQ(image.at(x, y, c), 0.1f + 0.3f * static_cast<float>(c));
        }
}

TEST_F(BlurTest, RadiusZeroCopies) {
    const auto value = [](int x, int y, int) { return static_cast<float>(x + 100 * y); };
    const auto image = blurred(plane(), {.radius = 0}, value);
    EXPECT_EQ(image.at(7, 31), value(7, 31, 0));
}

/// Standard deviation over the inner pixels.
double deviation(const Image& image, int border) {
    double sum = 0, squares = 0;
    int n = 0;
    for (int y = border; y < image.height - border; ++y)
        for (int x = border; x < image.width - border; ++x, ++n) {
            sum += image.at(x, y);
            squares += std::pow(image.at(x, y), 2);
        }
    return std::sqrt(squares / n - std::pow(sum / n, 2));
}

/// What a Gaussian of σ = radius/2 over both axes leaves of the deviation of independent values: Σw²/(Σw)².
double left_of_noise(int radius) {
    double sum = 0, squares = 0;
    for (int i = -radius; i <= radius; ++i) {
        const double w = std::exp(-2.0 * i * i / (radius * radius));
        sum += w;
        squares += w * w;
    }
    return squares / (sum * sum);
}

TEST_F(BlurTest, NoiseOnAPlaneIsReducedByTheKernelsFactor) {
    std::mt19937 random(11);
    std::normal_distribution<float> normal;
    std::vector<float> noise(48 * 48);
    for (auto& value : noise) value = normal(random);
    for (const int radius : {2, 4}) {
        const auto image = blurred(plane(), {.radius = radius}, [&](int x, int y, int) {
            return noise[static_cast<std::size_t>(48 * y + x)];
        });
        // n = 40² correlated values, about 40² · left_of_noise independent ones: within four standard errors.
        const double expected = left_of_noise(radius), n = 40.0 * 40 * expected;
        const double relative = deviation(image, 4) / expected;
        EXPECT_NEAR(relative, 1, 4 / std::sqrt(2 * n)) << radius;
        EXPECT_GT(std::abs(std::sqrt(expected) / expected - 1), 4 / std::sqrt(2 * n)) << "one axis only";
    }
}

TEST_F(BlurTest, EdgesAndCreasesAreNotCrossed) {
    // A step of 0.3 m in the floor, seen from straight above: left 0, right 1.
    SmallWorld step;
    step.quad({-2, 0, 2}, {0, 0, 2}, {0, 0, -2}, {-2, 0, -2});
    step.quad({0, 0.3f, 2}, {2, 0.3f, 2}, {2, 0.3f, -2}, {0, 0.3f, -2});
    const Shot shot(step.scene(), from_above(1), 32, 32);
    const auto value = [](int x, int, int) { return x < 16 ? 0.0f : 1.0f; };
    const auto kept = blurred(shot, {.radius = 6}, value);
    const auto crossed = blurred(shot, {.radius = 6, .plane_tolerance = 1e3f}, value);
    EXPECT_LT(kept.at(15, 16), 1e-3f);
    EXPECT_GT(kept.at(16, 16), 1 - 1e-3f);
    EXPECT_GT(crossed.at(15, 16), 0.2f) << "without the tangent plane the step is crossed";

    const Shot corner("builtin:corner", "view", 64, 64);
    run_gbuffer(corner);
    const auto normals = read("gbuffer.geometric_normal");
    const auto floor = [&](int x, int y, int) { return normals.at(x, y, 1) > 0.5f ? 1.0f : 0.0f; };
    const auto image = blurred(corner, {.radius = 6}, floor);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) EXPECT_NEAR(image.at(x, y), floor(x, y, 0), 1e-3f) << x << " " << y;
}

TEST_F(BlurTest, PixelsWithoutSurfaceKeepWhatTheyHaveAndGiveNothing) {
    const Shot shot("builtin:corner", "view", 64, 64);
    run_gbuffer(shot);
    const auto positions = read("gbuffer.position");
    const auto surface = [&](int x, int y) { return positions.at(x, y, 3) > 0; };
    const auto image = blurred(shot, {.radius = 8, .plane_tolerance = 1e3f, .normal_power = 0},
                               [&](int x, int y, int) { return surface(x, y) ? 0.5f : 1e6f; });
    int background = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            ASSERT_EQ(image.at(x, y), surface(x, y) ? 0.5f : 1e6f) << x << " " << y;
            background += surface(x, y) ? 0 : 1;
        }
    EXPECT_GT(background, 100);
}

TEST_F(BlurTest, ValuesThatAreNotFiniteDoNotSpread) {
    const auto image = blurred(plane(), {.radius = 4}, [](int x, int y, int) {
        return x == 20 && y == 20 ? std::numeric_limits<float>::quiet_NaN() : 2.0f;
    });
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) ASSERT_EQ(image.at(x, y), 2) << x << " " << y;
}

}  // namespace
}  // namespace ir::test
