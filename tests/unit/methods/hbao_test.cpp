// Horizon-based ambient occlusion against closed forms where the depth image shows all, and its own errors
// where it does not.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "renderers/methods/all_methods.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

class HbaoTest : public PassTest {
  protected:
    Image render(const Shot& shot, const Settings& settings, const std::string& key = "accessibility",
                 Inspection picked = {}, Processor body = Processor::gl) {
        const auto& all = methods::all_methods();
        const auto method =
            std::find_if(all.begin(), all.end(), [](const auto* m) { return m->description.id == "hbao"; });
        if (method == all.end()) throw std::runtime_error("hbao is not registered");
        auto inputs = shot.inputs();
        inputs.inspection = std::move(picked);
        inputs.processor = body;
        graph::FrameOptions options;
        options.wanted = {"*"};
        report =
            graph().run(**method, completed((*method)->description.parameters, settings), inputs, options);
        return read(key);
    }
    FrameReport report;
};

/// Exact enough for closed forms: no turning, nothing blurred, no bias.
Settings exact(int directions, int steps, double radius) {
    return {{"directions", std::int64_t{directions}},
            {"steps", std::int64_t{steps}},
            {"max_distance", radius},
            {"turning", std::string("none")},
            {"blur", false},
            {"angle_bias", 0.0}};
}

TEST_F(HbaoTest, OfAnOpenPlaneIsOne) {
    for (const char* name : {"top", "above"})
        for (const double radius : {0.0, 0.5})
            for (const char* weighting : {"cosine", "published"})
                for (const double bias : {0.0, 5.0}) {
                    auto settings = exact(16, 12, radius);
                    settings["weighting"] = std::string(weighting);
                    settings["angle_bias"] = bias;
                    settings["turning"] = std::string("pattern");
                    for (const auto body : {Processor::gl, Processor::host}) {
                        const auto image =
                            render({"builtin:plane", name, 48, 48}, settings, "accessibility", {}, body);
                        for (const float value : image.pixels)
                            ASSERT_NEAR(value, 1, 2e-6) << name << weighting << bias;
                    }
                }
}

/// Both march through what rays found, so that only rounding is between them. It may put a sample into the
/// next pixel, which changes one direction of some.
TEST_F(HbaoTest, TheHostMarchesAsTheDevice) {
    struct Choice {
        const char *weighting, *turning, *falloff;
        double radius;
    };
    // Every two values of two parameters stand beside each other.
    const Choice choices[] = {{"cosine", "none", "hard", 0},       {"cosine", "pattern", "smooth", 1},
                              {"cosine", "hash", "hard", 1},       {"published", "none", "smooth", 1},
                              {"published", "pattern", "hard", 0}, {"published", "hash", "smooth", 0}};
    for (const auto& choice : choices) {
        SCOPED_TRACE(std::string(choice.weighting) + ' ' + choice.turning);
        const Settings settings{{"weighting", std::string(choice.weighting)},
                                {"turning", std::string(choice.turning)},
                                {"falloff", std::string(choice.falloff)},
                                {"max_distance", choice.radius},
                                {"directions", std::int64_t{7}},
                                {"steps", std::int64_t{9}},
                                {"blur", false}};
        const Shot shot("builtin:still-life", "", 61, 43);
        const auto device = render(shot, settings, "hbao.sums");
        const auto host = render(shot, settings, "hbao.sums", {}, Processor::host);
        for (const auto& pass : report.passes) EXPECT_TRUE(pass.name != "march" || pass.queue == "cpu");
        std::size_t apart = 0;
        double mean[2] = {};
        for (std::size_t i = 0; i < host.pixels.size(); ++i) {
            apart += !(std::abs(host.pixels[i] - device.pixels[i]) <= 0.02f);
            mean[0] += device.pixels[i], mean[1] += host.pixels[i];
        }
        EXPECT_LT(double(apart), 0.03 * double(host.pixels.size()));
        EXPECT_NEAR(mean[1] / mean[0], 1, 1e-3);
    }
}

/// Accessibility at distance d from an endless wall at right angles, with t = d / d_max < 1. The smooth
/// fall-off is integrated over the wall: occlusion ∫ (1 − s²/d_max²) cosθ cosθ' / (π s²) dA.
double corner_accessibility(double t) {
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

double smooth_corner_accessibility(double t) {
    double closed = 0;
    constexpr int n = 200;
    const double reach = std::sqrt(1 - t * t), cell = reach / n;
    for (int i = 0; i < n; ++i)
        for (int j = -n; j < n; ++j) {
            const double u = (i + 0.5) * cell, v = (j + 0.5) * cell, s2 = t * t + u * u + v * v;
            if (s2 < 1) closed += (1 - s2) * u * t / (std::numbers::pi * s2 * s2) * cell * cell;
        }
    return 1 - closed;
}

/// The floor of a wide corner from halfway between both planes' normals, 2 m high: RMSE over floor pixels
/// within the radius of 0.5 m, and in the middle of the picture.
struct Errors {
    double rms = 0, bias = 0;
    int n = 0;
};

Shot wide_corner(int size, bool orthographic) {
    const auto eye = glm::vec3(1, 1, 0) * (orthographic ? 6.0f : 3.0f);
    auto view = looking(eye, {0, 0, 0}, {0, 1, 0}, orthographic ? 2.0f : 0.0f);
    return {scene::load_scene("builtin:corner?size=8"), view, size, size};
}

TEST_F(HbaoTest, NearACornerConvergesToTheClosedForm) {
    const auto errors = [&](const Shot& shot, const Settings& settings, auto expected) {
        const auto image = render(shot, settings);
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        Errors e;
        for (int y = 0; y < image.height; ++y)
            for (int x = image.width / 4; x < image.width * 3 / 4; ++x) {
                const double t = position.at(x, y, 0) / 0.5;
                if (normal.at(x, y, 1) < 0.5f || t > 0.9 || t < 0.1) continue;
                const double error = image.at(x, y) - expected(t);
                e.rms += error * error;
                ++e.n;
            }
        e.rms = std::sqrt(e.rms / e.n);
        return e;
    };
    for (const bool orthographic : {true, false}) {
        const auto small = wide_corner(64, orthographic), large = wide_corner(96, orthographic);
        const auto coarse = errors(small, exact(8, 8, 0.5), corner_accessibility);
        const auto fine = errors(large, exact(32, 48, 0.5), corner_accessibility);
        ASSERT_GT(coarse.n, 100);
        EXPECT_LT(fine.rms, 0.5 * coarse.rms) << coarse.rms << " to " << fine.rms;
        EXPECT_LT(fine.rms, 0.01);
        auto smooth = exact(32, 48, 0.5);
        smooth["falloff"] = std::string("smooth");
        const auto attenuated = errors(large, smooth, smooth_corner_accessibility);
        EXPECT_LT(attenuated.rms, 0.01);
        smooth["weighting"] = std::string("published");
        const auto published = errors(large, smooth, smooth_corner_accessibility);
        EXPECT_GT(published.rms, 2 * attenuated.rms) << "solid angles are another quantity";
    }
}

/// A floor of 1 m between walls of 1 m, endless along z, with their tops; seen from straight above.
Shot trench(int size) {
    SmallWorld world;
    world.quad({-0.5f, 0, 20}, {0.5f, 0, 20}, {0.5f, 0, -20}, {-0.5f, 0, -20});
    for (const float side : {-1.0f, 1.0f}) {
        const float a = std::min(0.5f * side, 20 * side), b = std::max(0.5f * side, 20 * side);
        world.quad({a, 1, 20}, {b, 1, 20}, {b, 1, -20}, {a, 1, -20});
        world.quad({0.5f * side, 0, 20}, {0.5f * side, 0, -20}, {0.5f * side, 1, -20}, {0.5f * side, 1, 20});
    }
    return {world.scene(), looking({0, 9, 0}, {0, 0, 0}, {0, 0, -1}, 8), size, size};
}

TEST_F(HbaoTest, InATrenchWhoseWallsAreSeenEdgeOnMatchesTheClosedForm) {
    const auto error = [&](int size, int directions, int steps) {
        const auto image = render(trench(size), exact(directions, steps, 0));
        const auto position = read("gbuffer.position");
        double squares = 0;
        int n = 0;
        for (int x = 0; x < size; ++x) {
            const double at = position.at(x, size / 2, 0);
            if (std::abs(at) > 0.45) continue;
            const auto open = [](double wall) { return 0.5 * wall / std::hypot(wall, 1.0); };
            squares += std::pow(image.at(x, size / 2) - open(0.5 - at) - open(0.5 + at), 2);
            ++n;
        }
        EXPECT_GT(n, 4);
        return std::sqrt(squares / n);
    };
    const double coarse = error(64, 8, 8), fine = error(128, 64, 64);
    EXPECT_LT(fine, 0.5 * coarse);
    EXPECT_LT(fine, 0.03);
}

TEST_F(HbaoTest, WhatTheDepthImageDoesNotShowIsMissedAndWhatItShowsIsThick) {
    // The floor of a corner, the wall just outside the picture: the truth is the closed form, HBAO says open.
    const auto scene = scene::load_scene("builtin:corner?size=8");
    const auto outside =
        render({scene, looking({0.3f, 5, 0}, {0.3f, 0, 0}, {0, 0, -1}, 0.5f), 32, 32}, exact(16, 12, 1));
    EXPECT_EQ(*std::min_element(outside.pixels.begin(), outside.pixels.end()), 1);
    EXPECT_LT(corner_accessibility(0.05), 0.6);
    const auto cut = read("hbao.cut");
    EXPECT_GT(cut.at(0, 16), 0.3f) << "half of the directions leave the picture by the wall";

    // A plate of no thickness 0.5 m above the floor: beside it the truth is the plate's own form factor,
    // while its height field closes everything behind its edge.
    SmallWorld plate;
    plate.square({0, 0, 0}, {0, 1, 0}, 20);
    plate.quad({0.1f, 0.5f, 0.1f}, {0.2f, 0.5f, 0.1f}, {0.2f, 0.5f, -0.1f}, {0.1f, 0.5f, -0.1f});
    const auto image =
        render({plate.scene(), looking({0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 2), 64, 64}, exact(32, 64, 0));
    double truth = 0;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const double x = 0.1 + (i + 0.5) / 400, z = -0.1 + (j + 0.5) / 200;
            truth += 0.25 / std::pow(x * x + z * z + 0.25, 2) / std::numbers::pi * 0.1 * 0.2 / 1600;
        }
    EXPECT_LT(truth, 0.03);
    EXPECT_GT(1 - image.at(32, 32), 5 * truth);
}

TEST_F(HbaoTest, TheSamePictureTwiceAndInAnyNumberOfDispatches) {
    const auto shot = wide_corner(48, false);
    const Settings settings{{"directions", std::int64_t{64}}, {"steps", std::int64_t{400}}};
    const auto a = render(shot, settings), b = render(shot, settings);
    EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
}

TEST_F(HbaoTest, WhatExplainsAPixelAddsUpToIt) {
    for (const char* weighting : {"cosine", "published"}) {
        const Settings settings{{"weighting", std::string(weighting)},
                                {"directions", std::int64_t{70}},
                                {"falloff", std::string("smooth")}};
        Inspection picked;
        picked.x = 30;
        picked.y = 40;
        const auto raw = render(wide_corner(64, false), settings, "hbao.raw", picked);
        const auto bytes = graph().read_buffer("hbao.explain.horizons").value();
        std::vector<float> horizons(bytes.size() / sizeof(float));
        std::memcpy(horizons.data(), bytes.data(), bytes.size());
        double sum = 0;
        for (std::size_t i = 5; i < 8 * 70; i += 8) sum += horizons.at(i);
        EXPECT_NEAR(sum, raw.at(30, 40), 1e-5);
        EXPECT_EQ(report.counters.at("hbao.explain.horizons_count"), 70);
        EXPECT_GT(report.counters.at("hbao.explain.samples_count"), 70);
        EXPECT_LT(raw.at(30, 40), 0.99f);
    }
}

TEST_F(HbaoTest, TheBlurTakesThePatternAway) {
    const auto shot = wide_corner(96, true);
    const Settings few{{"directions", std::int64_t{4}}, {"max_distance", 0.5}};
    const auto blurred = render(shot, few), raw = read("hbao.raw");
    const auto many = render(shot, exact(128, 64, 0.5));
    const auto error = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += std::pow(image.pixels[i] - many.pixels[i], 2);
        return std::sqrt(sum / static_cast<double>(image.pixels.size()));
    };
    EXPECT_LT(error(blurred), 0.6 * error(raw));
}

}  // namespace
}  // namespace ir::test
