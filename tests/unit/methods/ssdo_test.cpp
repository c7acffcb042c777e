// Screen-space directional occlusion against closed forms where the picture shows all, and its own errors
// where it does not.
#include <bit>
#include <cmath>
#include <map>
#include <numbers>

#include "renderers/passes/lights/environment_light.h"
#include "tests/unit/methods/ssdo_fixture.h"

namespace ir::test {
namespace {

constexpr Processor bodies[] = {Processor::gl, Processor::host};

TEST_F(SsdoTest, AnOpenPlaneIsExactlyOpenAndReceivesNothing) {
    for (const char* camera : {"top", "above"})
        for (const double radius : {0.0, 0.5}) {
            body = bodies[radius > 0];
            Shot shot("builtin:plane", camera, 48, 48);
            shot.scene.environment = {{0.5f, 1, 2}, nullptr};
            const auto indirect = render(shot, sky_by_occlusion({{"max_distance", radius}}));
            const auto open = read("ssdo.accessibility"), sky = read("ssdo.sky.raw"),
                       albedo = read("gbuffer.albedo");
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x) {
                    ASSERT_EQ(open.at(x, y), 1) << camera << radius;
                    ASSERT_EQ(indirect.at(x, y, 0), 0) << camera << radius;
                    ASSERT_NEAR(sky.at(x, y, 2), 2 * albedo.at(x, y, 2), 1e-5);
                }
        }
}

/// Six walls about the camera, 4 m apart, and an environment outside.
scene::Scene closed_room() {
    SmallWorld world;
    const glm::vec3 sides[] = {{2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}};
    for (const auto& side : sides) world.square(side, -side / 2.0f, 2);
    auto scene = world.scene();
    scene.environment = {glm::vec3(1), nullptr};
    return scene;
}

TEST_F(SsdoTest, SamplesKeepTheEnvironmentOutOfAClosedRoom) {
    const Shot shot(closed_room(), looking({0, 0, 0}, {1, 0.1f, 0.2f}), 32, 32);
    const auto light_in_the_middle = [&](const char* by) {
        return render(shot, {{"environment_by", std::string(by)}}, "radiance").at(16, 16);
    };
    const auto is_told = [&] {
        return std::ranges::any_of(report.messages, [](const Message& message) {
            return message.text.find("environment_by=samples") != std::string::npos;
        });
    };
    EXPECT_EQ(light_in_the_middle("samples"), 0);
    EXPECT_FALSE(is_told());
    EXPECT_GT(light_in_the_middle("occlusion"), 0.2f) << "as published, nothing beyond a step closes";
    EXPECT_TRUE(is_told());
}

/// ∫ cosθ / π (1 − t / r)⁺ dω over the directions to an endless wall at distance d, t the way to it: what
/// steps of uniform length in (0, r] find behind it.
double occlusion_by_wall(double d, double r) {
    constexpr int n = 200;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double height = (i + 0.5) / n, azimuth = std::numbers::pi * ((j + 0.5) / n - 0.5);
            const double t = d / (std::sqrt(1 - height * height) * std::cos(azimuth));
            sum += height / std::numbers::pi * std::max(1 - t / r, 0.0) * std::numbers::pi / (n * n);
        }
    return sum;
}

TEST_F(SsdoTest, NearAWallAccessibilityTendsToALinearFallOff) {
    for (const bool orthographic : {true, false}) {
        body = bodies[orthographic];
        const auto eye = glm::vec3(1, 1, 0) * (orthographic ? 6.0f : 3.0f);
        const Shot shot(scene::load_scene("builtin:corner?size=8"),
                        looking(eye, {0, 0, 0}, {0, 1, 0}, orthographic ? 2.0f : 0.0f), 64, 64);
        const auto open = render(shot, many_samples(256, 0.5), "ssdo.accessibility");
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        double bias = 0, squares = 0;
        int n = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 16; x < 48; ++x) {
                const double d = position.at(x, y, 0);
                if (normal.at(x, y, 1) < 0.5f || d > 0.6 || d < 0.03) continue;
                const double error = open.at(x, y) - 1 + occlusion_by_wall(d, 0.5);
                bias += error;
                squares += error * error;
                ++n;
            }
        ASSERT_GT(n, 100);
        EXPECT_NEAR(bias / n, 0, 0.003) << orthographic;
        EXPECT_LT(std::sqrt(squares / n), 0.02) << orthographic;
    }
}

/// A picture's sum, and the part of its values that are farther from another's than a tenth of their mean.
struct Apart {
    double part = 0, sum = 0, other_sum = 0;
};
Apart apart(const Image& image, const Image& other) {
    Apart result;
    for (const float value : image.pixels) result.sum += value;
    const double tolerance = 0.1 * result.sum / static_cast<double>(image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        result.other_sum += other.pixels[i];
        const bool is_near = std::abs(image.pixels[i] - other.pixels[i]) <= tolerance;
        result.part += is_near ? 0 : 1 / static_cast<double>(image.pixels.size());
    }
    return result;
}

/// Rounding may put a step's end into the next pixel, or in front of what it was behind.
TEST_F(SsdoTest, TheHostGathersAsTheDevice) {
    struct Choice {
        const char *estimator, *turning, *materials;
        double radius;
        bool orthographic;
        int layers = 1;
    };
    // Every two values of two parameters stand beside each other.
    const Choice choices[] = {{"density", "none", "gltf", 0, false},
                              {"density", "pattern", "metalness-blend", 0.3, true},
                              {"density", "hash", "lambert", 0.3, false},
                              {"published", "none", "metalness-blend", 0.3, false},
                              {"published", "pattern", "lambert", 0, false},
                              {"published", "hash", "gltf", 0.3, true},
                              {"density", "hash", "metalness-blend", 0, false},
                              {"density", "pattern", "gltf", 0.3, false},
                              {"published", "none", "lambert", 0.3, true},
                              {"density", "hash", "gltf", 0.3, true, 2},
                              {"published", "pattern", "lambert", 0.3, false, 4}};
    auto scene = scene::load_scene("builtin:still-life");
    scene.environment = {{0.5f, 1, 2}, nullptr};
    const auto camera = scene.cameras.at(0);
    for (const auto& choice : choices) {
        SCOPED_TRACE(std::string(choice.estimator) + ' ' + choice.turning + ' ' + choice.materials);
        auto view = looking(camera.eye, camera.target);
        if (choice.orthographic) view = looking(camera.eye, camera.target, {0, 1, 0}, 1);
        const Shot shot(scene, view, 61, 43);
        const auto settings = sky_by_occlusion({{"estimator", std::string(choice.estimator)},
                                                {"turning", std::string(choice.turning)},
                                                {"materials", std::string(choice.materials)},
                                                {"max_distance", choice.radius},
                                                {"samples", std::int64_t{21}},
                                                {"layers", std::int64_t{choice.layers}},
                                                {"blur", false}});
        const std::string keys[] = {"ssdo.indirect.raw", "ssdo.sky.raw", "ssdo.accessibility", "ssdo.cut"};
        std::map<std::string, Image> device;
        body = Processor::gl;
        render(shot, settings);
        for (const auto& key : keys) device[key] = read(key);
        body = Processor::host;
        render(shot, settings);
        EXPECT_TRUE(ran_on_host(report, "directional occlusion"));
        EXPECT_TRUE(ran_on_host(report, "indirect light"));
        for (const auto& key : keys) {
            const auto host = read(key);
            const auto difference = apart(device[key], host);
            EXPECT_GT(difference.sum, 0) << key;
            EXPECT_LT(difference.part, 0.03) << key;
            EXPECT_NEAR(difference.other_sum / difference.sum, 1, this->device().software() ? 5e-3 : 1e-2)
                << key;
        }
    }
}

/// Mean over floor pixels of light received over ρ L F, and its largest value over the wall's radiance.
struct Received {
    double ratio = 0, largest = 0;
    int n = 0;
};

class SsdoWallTest : public SsdoTest {
  protected:
    Received received(bool orthographic, const Settings& settings, double radius) {
        const Shot shot(lit_wall(),
                        looking({3.2f, 2.4f, 0.7f}, {0.6f, 0.3f, 0}, {0, 1, 0}, orthographic ? 2.6f : 0.0f),
                        96, 96);
        const auto indirect = render(shot, settings);
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal"),
                   senders = read("ssdo.senders");
        double wall = 0, sum = 0, expected = 0;
        Received result;
        for (std::size_t i = 0; i < 96 * 96; ++i)  // one radiance all over
            if (normal.pixels[4 * i] > 0.9f) wall = senders.pixels[4 * i];
        EXPECT_GT(wall, 0.1);
        for (int y = 0; y < 96; ++y)
            for (int x = 0; x < 96; ++x) {
                const double from_wall = position.at(x, y, 0);
                if (normal.at(x, y, 1) < 0.9f || from_wall < 0.05) continue;
                sum += indirect.at(x, y, 0);
                expected += 0.8 * wall * wall_form_factor(from_wall, position.at(x, y, 2), radius);
                result.largest = std::max(result.largest, indirect.at(x, y, 0) / wall);
                ++result.n;
            }
        result.ratio = sum / expected;
        return result;
    }
};

TEST_F(SsdoWallTest, TheDensityEstimatorTendsToTheFormFactorAndThePublishedOneDoesNot) {
    for (const bool orthographic : {false, true}) {
        body = bodies[orthographic];
        const auto unlimited = received(orthographic, many_samples(128, 0), 1e9);
        ASSERT_GT(unlimited.n, 1000);
        EXPECT_NEAR(unlimited.ratio, 1, 0.02) << orthographic;
        EXPECT_LT(unlimited.largest, 0.8) << "no floor sees more than half a wall; the rest is noise";
        const auto limited = received(orthographic, many_samples(128, 0.7), 0.7);
        EXPECT_NEAR(limited.ratio, 1, 0.05) << "light fades over the last twentieth of the radius";
        auto settings = many_samples(128, 0.7);
        settings["estimator"] = std::string("published");
        settings["min_distance"] = 1.0;
        const auto clamped = received(orthographic, settings, 0.7);
        settings["min_distance"] = 0.01;
        const auto published = received(orthographic, settings, 0.7);
        EXPECT_GT(std::abs(published.ratio - 1), 0.1);
        EXPECT_LT(clamped.ratio, 0.5);
    }
}

/// The published estimator knows no distance but that of its steps.
TEST_F(SsdoTest, StepsHaveARadiusOfTheirOwn) {
    const Shot shot(lit_wall(), looking({2.5f, 1.2f, 0.6f}, {0.4f, 0.3f, 0}), 32, 32);
    const auto with = [&](double max_distance, double step_radius) {
        return render(shot, {{"estimator", std::string("published")},
                             {"blur", false},
                             {"max_distance", max_distance},
                             {"step_radius", step_radius}})
            .pixels;
    };
    const auto expected = with(0.4, 0);
    EXPECT_EQ(with(0, 0.4), expected);
    EXPECT_TRUE(report.messages.empty());
    EXPECT_EQ(with(0.4, 3), expected) << "steps are no longer than the maximum distance";
    EXPECT_NE(with(0, 0), expected);
    EXPECT_FALSE(report.messages.empty());
}

TEST_F(SsdoTest, SidesThatTheCameraDoesNotSeeOccludeButSendNothing) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 4);
    world.quad({-0.3f, 0.3f, 0.3f}, {0.3f, 0.3f, 0.3f}, {0.3f, 0.3f, -0.3f}, {-0.3f, 0.3f, -0.3f});
    auto scene = world.scene();
    scene.lights = lit_wall().lights;
    const Shot shot(scene, looking({0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 2), 64, 64);
    Inspection picked;
    picked.x = 18;
    picked.y = 32;
    const auto indirect = render(shot, many_samples(64, 1), "ssdo.indirect.raw", picked);
    for (const float value : indirect.pixels)
        if (value != 0) FAIL() << "the plate's top sends down";
    EXPECT_LT(read("ssdo.accessibility").at(18, 32), 0.95f);
    const auto lines = explained("ssdo.explain.lines");
    int turned_away = 0;
    for (std::size_t i = 0; i < 64; ++i) {
        std::uint32_t role;
        std::memcpy(&role, &lines.at(15 * i + 6), 4);
        turned_away += role == 3;
    }
    EXPECT_GT(turned_away, 2);
}

TEST_F(SsdoTest, WhatLiesOutsideOfThePictureIsMissedAndCounted) {
    const Shot shot(lit_wall(), looking({0.35f, 3, 0}, {0.35f, 0, 0}, {0, 0, -1}, 0.5f), 32, 32);
    const auto indirect = render(shot, many_samples(64, 1));
    EXPECT_EQ(*std::max_element(indirect.pixels.begin(), indirect.pixels.end()), 0);
    EXPECT_GT(read("ssdo.cut").at(0, 16), 0.3f);
    EXPECT_EQ(read("ssdo.accessibility").at(0, 16), 1);
    EXPECT_GT(wall_form_factor(0.1, 0, 1), 0.2);
}

TEST_F(SsdoTest, WhatExplainsAPixelAddsUpToIt) {
    Shot shot("builtin:cornell", "", 64, 64);
    shot.scene.environment = {{0.5f, 1, 2}, nullptr};
    for (const char* estimator : {"density", "published"})
        for (const char* materials : {"lambert", "gltf"}) {
            const std::int64_t layers = std::string(materials) == "gltf" ? 3 : 1;
            auto settings = sky_by_occlusion(many_samples(70, 0.3));
            settings["estimator"] = std::string(estimator);
            settings["layers"] = layers;
            settings["materials"] = std::string(materials);
            Inspection picked;
            picked.x = 20;
            picked.y = 55;
            const auto raw = render(shot, settings, "ssdo.indirect.raw", picked), sky = read("ssdo.sky.raw");
            const auto samples = explained("ssdo.explain.samples"), lines = explained("ssdo.explain.lines");
            double sent = 0, seen = 0, of_layers = 0;
            for (std::size_t i = 0; i < 70; ++i) {
                sent += samples.at(12 * i + 5);
                seen += samples.at(12 * i + 10);
            }
            const auto is_sender = [](float role) { return std::bit_cast<std::uint32_t>(role) == 2; };
            for (std::size_t i = 0; i < 70; ++i)
                EXPECT_TRUE(samples.at(12 * i + 5) == 0 || is_sender(samples.at(12 * i + 3)));
            for (std::size_t i = 0; i < static_cast<std::size_t>(70 * layers); ++i) {
                of_layers += lines.at(15 * i + 8);
                EXPECT_TRUE(lines.at(15 * i + 8) == 0 || is_sender(lines.at(15 * i + 6)));
            }
            EXPECT_GT(sent, 0);
            EXPECT_NEAR(sent, raw.at(20, 55, 0), 1e-5 * sent);
            EXPECT_NEAR(of_layers, sent, 1e-5 * sent);
            EXPECT_NEAR(seen, sky.at(20, 55, 2), 1e-5 * seen);
            EXPECT_EQ(report.counters.at("ssdo.explain.lines_count"), 70 * layers);
        }
}

TEST_F(SsdoTest, PicturesAreTheSumsOfTheirParts) {
    Shot shot("builtin:cornell", "", 48, 48);
    shot.scene.environment = {{0.5f, 1, 2}, nullptr};
    for (const auto& [paths, by] : {std::pair{"direct", "samples"},
                                    {"indirect", "samples"},
                                    {"full", "samples"},
                                    {"direct", "occlusion"},
                                    {"full", "occlusion"}}) {
        const auto radiance =
            render(shot, {{"paths", std::string(paths)}, {"environment_by", std::string(by)}}, "radiance");
        const auto direct = read("ssdo.direct"), indirect = read("ssdo.indirect"),
                   emission = read("gbuffer.emission"), normal = read("gbuffer.geometric_normal");
        const bool full = std::string(paths) == "full";
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x)
                for (int c = 0; c < 3; ++c) {
                    float expected = full ? shot.scene.environment.constant[c] : 0;
                    if (rgb(normal, x, y) != glm::vec3(0)) {
                        expected = full ? emission.at(x, y, c) : 0;
                        if (std::string(paths) != "indirect") expected += direct.at(x, y, c);
                        if (std::string(paths) != "direct") expected += indirect.at(x, y, c);
                    }
                    ASSERT_NEAR(radiance.at(x, y, c), expected, 1e-5 * (1 + expected)) << paths;
                }
    }
}

TEST_F(SsdoTest, AnEnvironmentMapLightsAnOpenSlopeByItsIntegral) {
    Image map(32, 16, 3);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c)
                map.at(x, y, c) = x > 20 && x < 24 && y > 3 && y < 8 ? 10.0f : 0.1f * c;
    SmallWorld world;
    const auto normal = glm::normalize(glm::vec3(0.3f, 1, 0.5f));
    world.square({0, 0, 0}, normal, 1);
    auto scene = world.scene();
    scene.environment = {{}, std::make_shared<Image>(map)};
    const Shot shot(scene, looking(3.0f * normal, {0, 0, 0}, {1, 0, 0}, 1), 16, 16);
    const passes::EnvironmentLight light(scene.environment);
    glm::dvec3 expected(0);
    constexpr int n = 400;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const double height = -1 + (i + 0.5) * 2 / n, azimuth = std::numbers::pi * (j + 0.5) / n;
            const double across = std::sqrt(1 - height * height);
            const glm::vec3 way(across * std::cos(azimuth), height, across * std::sin(azimuth));
            expected += glm::dvec3(light.radiance(way)) * double(std::max(glm::dot(way, normal), 0.0f)) /
                        std::numbers::pi * (2.0 / n) * (std::numbers::pi / n);
        }
    for (const auto each : bodies) {
        body = each;
        const auto sky = render(shot, sky_by_occlusion(many_samples(4096, 1)), "ssdo.sky.raw");
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sky.at(8, 8, c), expected[c], 0.02 * expected[c]) << c;
    }
}

TEST_F(SsdoTest, TheSamePictureTwiceAndAnotherByAnotherSeed) {
    const Shot shot("builtin:cornell", "", 32, 32);
    const auto a = render(shot, many_samples(70, 0.3)), b = render(shot, many_samples(70, 0.3));
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
    EXPECT_NE(render(shot, many_samples(70, 0.3), "ssdo.indirect.raw", {}, 2).pixels, a.pixels);
}

TEST_F(SsdoTest, TheBlurTakesNoiseAwayAndLeavesMaterials) {
    const Shot shot("builtin:cornell", "", 64, 64);
    const auto many = render(shot, many_samples(1024, 0.3), "ssdo.indirect");
    const auto blurred = render(shot, {{"samples", std::int64_t{8}}, {"max_distance", 0.3}}, "ssdo.indirect"),
               raw = read("ssdo.indirect.raw");
    const auto error = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            if (i % 4 != 3) sum += std::pow(image.pixels[i] - many.pixels[i], 2);
        return std::sqrt(sum);
    };
    EXPECT_LT(error(blurred), 0.7 * error(raw));
}

}  // namespace
}  // namespace ir::test
