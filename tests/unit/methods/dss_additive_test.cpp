// Splatting without visibility: form factors and light against closed forms, in expectation over the levels;
// what it cannot know: that surfels hide each other.
#include <numeric>

#include "tests/unit/methods/dss_additive_fixture.h"

namespace ir::test {
namespace {

TEST_F(AdditiveTest, OneLevelAddsUpToTheFormFactorOfARectangle) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 0.4f, 32);
    for (const bool orthographic : {true, false}) {
        splat(floor(32, orthographic), run);
        const auto result = read("result"), sum = read("additive.sum");
        for (int y = 0; y < 32; y += 5)
            for (int x = 0; x < 32; x += 3) {
                const double expected = expected_at(x, y, 0.4, 0.5);
                EXPECT_NEAR(sum.at(x, y), expected, 0.004 * expected + 1e-5);
                EXPECT_FLOAT_EQ(result.at(x, y), 1 - sum.at(x, y));
            }
    }
}

/// Mean and its standard error.
std::pair<double, double> mean_of(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (n * (n - 1)))};
}

TEST_F(AdditiveTest, FourLevelsDoSoInExpectation) {
    // n = 16 seeds, each the mean of occlusion over 24² pixels relative to the closed form; alpha = 1e-4: t
    // of 15 degrees of freedom is 5.24. Discs in place of the square err by less than 0.2 %. The mutant does
    // not let surfels stand for others.
    AdditiveRun run;
    run.surfels = square_above(0.5f, 0.4f, 40);
    run.parameters.levels = 4;
    run.parameters.transport.max_distance = 8 * 0.35f;
    const auto shot = floor(24);
    const auto relative_error = [&] {
        std::vector<double> errors;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            run.seed = seed;
            splat(shot, run);
            const auto sum = read("additive.sum");
            double found = 0, expected = 0;
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 24; ++x) found += sum.at(x, y);
            const auto positions = read("gbuffer.position");
            for (int y = 0; y < 24; ++y)
                for (int x = 0; x < 24; ++x) {
                    const auto at = rgb(positions, x, y);
                    expected += rectangle_form_factor(-0.4 - at.x, 0.4 - at.x, -0.4 - at.z, 0.4 - at.z, 0.5);
                }
            errors.push_back(found / expected - 1);
        }
        return mean_of(errors);
    };
    const auto [mean, error] = relative_error();
    RecordProperty("relative_error", std::to_string(mean) + " +- " + std::to_string(error));
    EXPECT_LT(error, 0.01) << "too noisy to tell";
    EXPECT_LT(std::abs(mean), 5.24 * error + 0.002);
    break_shader("methods/deep-screen-space/splatting/additive_share.glsl", "ldexp(1.0, 2 * level)", "1.0");
    const auto [wrong, wrong_error] = relative_error();
    EXPECT_GT(std::abs(wrong), 5.24 * wrong_error + 0.002);
}

TEST_F(AdditiveTest, LevelsDivideSurfelsByDistance) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 1.5f, 16);
    run.parameters.levels = 3;
    run.parameters.transport.max_distance = 4 * 0.7f;
    splat(floor(), run);
    // Distances of the middle are 0.5 m and more: level 0 ends at 0.7 m, level 1 at 1.4 m; the square's
    // corners are 2.2 m away.
    for (int level = 0; level < 3; ++level) {
        const auto image = read("additive.levels", level);
        EXPECT_GT(*std::max_element(image.pixels.begin(), image.pixels.end()), 0) << level;
    }
    run.surfels = {disc({0, 0.5f, 0}, {0, 1, 0}, 0.05f)};
    splat(floor(), run);
    const auto positions = read("gbuffer.position");
    const auto first = read("additive.levels", 0), second = read("additive.levels", 1);
    int seen = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const float distance = glm::distance(rgb(positions, x, y), run.surfels[0].centre_ws);
            EXPECT_EQ(first.at(x, y) > 0, distance <= 0.7f);
            if (second.at(x, y) > 0) {
                EXPECT_GT(distance, 0.7f);
            }
            seen += second.at(x, y) > 0 ? 1 : 0;
        }
    EXPECT_GT(seen, 20);
}

TEST_F(AdditiveTest, IrradianceOfALambertianSquareIsPiTimesItsRadianceTimesItsFormFactor) {
    AdditiveRun run;
    const glm::vec3 radiance(3, 1, 0.25f);
    run.surfels = square_above(0.5f, 0.4f, 32, radiance);
    run.parameters.transport.paths = Transport::Paths::indirect;
    run.parameters.transport.materials = Transport::Materials::lambert;
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    auto scene = small.scene();
    scene.materials[0].base_colour = {0.5f, 0.8f, 0.2f, 1};
    splat({scene, dss_camera({0, 3, 0}, {0, 0, 0}, true, 2), 32, 32}, run);
    const auto result = read("result"), sum = read("additive.sum");
    for (int y = 0; y < 32; y += 5)
        for (int x = 0; x < 32; x += 5)
            for (std::size_t c = 0; c < 3; ++c) {
                // L_o = ρ/π E, E = π L F.
                const double expected = radiance[static_cast<int>(c)] * expected_at(x, y, 0.4, 0.5);
                EXPECT_NEAR(sum.at(x, y, c), expected, 0.004 * expected + 1e-5);
                const double albedo = scene.materials[0].base_colour[static_cast<int>(c)];
                EXPECT_NEAR(result.at(x, y, c), albedo * expected, 0.006 * albedo * expected + 1e-5);
            }
}

TEST_F(AdditiveTest, EachSideOfASurfelSendsItsOwnRadiance) {
    AdditiveRun run;
    run.parameters.transport.paths = Transport::Paths::indirect;
    run.parameters.transport.materials = Transport::Materials::lambert;
    run.surfels = {disc({0, 0.5f, 0}, {0, -1, 0}, 0.1f)};
    run.surfels[0].radiance_front = {1, 0, 0};
    run.surfels[0].radiance_back = {0, 1, 0};
    const auto middle = [&] {
        splat(floor(), run);
        return rgb(read("result"), 16, 16);
    };
    const auto from_front = middle();
    EXPECT_GT(from_front.r, 0);
    EXPECT_EQ(from_front.g, 0);
    run.surfels[0].normal_ws = {0, 1, 0};
    const auto from_back = middle();
    EXPECT_EQ(from_back, glm::vec3(0, from_front.r, 0));
    run.parameters.backs = dss::Backs::black;
    EXPECT_EQ(middle(), glm::vec3(0));
}

TEST_F(AdditiveTest, GlossyReceiversReflectWhatLiesInTheMirrorDirection) {
    // A smooth metal floor seen at 45 degrees from +z: a surfel in the mirror's direction (-z) is seen, one
    // on the viewer's side is not.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    auto scene = small.scene();
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0.3f;
    const Shot shot(scene, dss_camera({0, 2, 2}, {0, 0, 0}), 16, 16);
    AdditiveRun run;
    run.parameters.transport.paths = Transport::Paths::indirect;
    const auto towards = [&](float z) {
        run.surfels = {disc({0, 1, z}, {0, -1, -z}, 0.1f)};
        splat(shot, run);
        return read("result").at(8, 8);
    };
    EXPECT_GT(towards(-1), 20 * towards(1));
}

TEST_F(AdditiveTest, WhatHidesEachOtherAddsUp) {
    AdditiveRun run;
    const auto sum_of = [&](std::vector<Disc> surfels) {
        run.surfels = std::move(surfels);
        splat(floor(), run);
        return read("additive.sum");
    };
    const auto near = square_above(0.5f, 0.4f, 12);
    const auto behind = square_above(0.6f, 0.4f, 12);  // hidden where the floor's middle looks up
    auto both = near;
    both.insert(both.end(), behind.begin(), behind.end());
    const auto a = sum_of(near), b = sum_of(behind), together = sum_of(both);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        EXPECT_NEAR(together.pixels[i], a.pixels[i] + b.pixels[i], 1e-5f);
    // Ten of them are darker than all that there is to see; the result ends at 0.
    std::vector<Disc> pile;
    for (int i = 0; i < 10; ++i) pile.insert(pile.end(), near.begin(), near.end());
    EXPECT_GT(sum_of(pile).at(16, 16), 1.5f);
    EXPECT_EQ(read("result").at(16, 16), 0);
}

TEST_F(AdditiveTest, NothingHappensBeyondTheReachAndAllWithinAHugeOne) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 0.4f, 24);
    run.parameters.levels = 4;
    run.parameters.transport.max_distance = 0.49f;
    splat(floor(), run);
    for (const float value : read("result").pixels) ASSERT_EQ(value, 1);
    run.parameters.transport.max_distance = 1e-6f;
    splat(floor(), run);
    for (const float value : read("result").pixels) ASSERT_EQ(value, 1);
    run.parameters.transport.max_distance = 1e9f;
    splat(floor(), run);
    EXPECT_NEAR(read("additive.sum").at(16, 16), expected_at(16, 16, 0.4, 0.5), 0.002);
}

TEST_F(AdditiveTest, EstimatedShellsBeginWhereTheFormFactorIsTheTradeOffAndEndAtTheWholeReach) {
    AdditiveRun run;
    run.surfels = {disc({0, 0.3f, 0}, {0, 1, 0}, 0.06f)};
    const auto sum = [&](dss::Influence influence, int levels, float epsilon = 0.01f) {
        run.parameters.influence = influence;
        run.parameters.levels = levels;
        run.parameters.trade_off = epsilon;
        splat(floor(), run);
        return read("additive.sum");
    };
    using enum dss::Influence;
    run.parameters.transport.max_distance = 0.6f;  // two shells of 0.3 m
    // radius / √ε is the whole reach: one shell is left.
    const auto one_shell = sum(constant, 1);
    EXPECT_EQ(sum(estimated, 2).pixels, one_shell.pixels);
    EXPECT_EQ(one_shell.at(0, 0), 0) << "beyond the reach";
    EXPECT_GT(one_shell.at(16, 16), 0);
    // 0.12 m, less than the least that reaches as far.
    EXPECT_EQ(sum(estimated, 2, 0.25f).pixels, sum(constant, 2).pixels);
    // Never beyond the transport's maximum distance, however small ε is.
    run.parameters.transport.max_distance = 0.29f;
    const auto none = sum(estimated, 2, 1e-6f);
    for (const float value : none.pixels) ASSERT_EQ(value, 0);
}

TEST_F(AdditiveTest, SmoothFallOffWeighsByDistance) {
    AdditiveRun run;
    run.surfels = {disc({0.2f, 0.5f, 0}, {0.3f, 1, 0.1f}, 0.05f)};
    run.parameters.transport.max_distance = 1;
    splat(floor(), run);
    const auto hard = read("additive.sum"), positions = read("gbuffer.position");
    run.parameters.transport.falloff = Transport::Falloff::smooth;
    splat(floor(), run);
    const auto smooth = read("additive.sum");
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const float t = glm::distance(rgb(positions, x, y), run.surfels[0].centre_ws);
            EXPECT_NEAR(smooth.at(x, y), hard.at(x, y) * (1 - t * t), 1e-7f);
        }
}

TEST_F(AdditiveTest, CullingChangesNoBit) {
    AdditiveRun run;
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (std::uint32_t i = 0; i < 400; ++i)
        run.surfels.push_back(disc(1.5f * glm::vec3(unit(random), unit(random), unit(random)),
                                   random_direction(random), 0.04f, i));
    run.parameters.levels = 4;
    run.parameters.transport.max_distance = 1.2f;
    std::vector<Shot> shots;
    shots.emplace_back("builtin:corner", "view", 29, 21);
    SmallWorld small;
    small.square({0, -1, 0}, {0, 1, 0}, 3);
    small.square({0, 0, -1}, {0, 0, 1}, 2);
    // The eye is inside of many surfels' spheres.
    shots.emplace_back(small.scene(), dss_camera({0, -0.5f, 0.5f}, {0, -0.8f, -1}), 24, 17);
    shots.emplace_back(small.scene(), dss_camera({1, 2, 1}, {0, -1, -0.5f}, true, 3), 21, 21);
    double culled = 0;
    for (const auto& shot : shots)
        for (const auto paths : {Transport::Paths::ao, Transport::Paths::indirect}) {
            run.parameters.transport.paths = paths;
            run.parameters.splat_culling = true;
            culled += splat(shot, run).counters.at("splats.culled");
            const auto with = read("result").pixels;
            run.parameters.splat_culling = false;
            splat(shot, run);
            EXPECT_EQ(read("result").pixels, with);
        }
    EXPECT_GT(culled, 100);
}

TEST_F(AdditiveTest, TheOrderOfSurfelsOnlyRounds) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 0.4f, 16);
    run.parameters.levels = 3;
    run.parameters.transport.max_distance = 2;
    splat(floor(), run);
    const auto forwards = read("additive.sum");
    splat(floor(), run);
    EXPECT_EQ(read("additive.sum").pixels, forwards.pixels);
    std::reverse(run.surfels.begin(), run.surfels.end());
    splat(floor(), run);
    const auto backwards = read("additive.sum");
    for (std::size_t i = 0; i < forwards.pixels.size(); ++i)
        ASSERT_NEAR(backwards.pixels[i], forwards.pixels[i], 1e-5f);
}

TEST_F(AdditiveTest, BlurringLevelsKeepsTheMeanAndTakesNoiseAway) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 2, 32);
    run.parameters.levels = 4;
    run.parameters.transport.max_distance = 4;
    const auto moments = [&] {
        splat(floor(48), run);
        const auto sum = read("additive.sum");
        double mean = 0, squares = 0;
        int n = 0;
        for (int y = 12; y < 36; ++y)
            for (int x = 12; x < 36; ++x, ++n) {
                mean += sum.at(x, y);
                squares += std::pow(sum.at(x, y), 2);
            }
        mean /= n;
        return std::pair(mean, std::sqrt(squares / n - mean * mean));
    };
    const auto raw = moments();
    run.parameters.reconstruction.blur.blur = true;
    const auto blurred = moments();
    EXPECT_NEAR(blurred.first, raw.first, 0.03 * raw.first);
    EXPECT_LT(blurred.second, 0.5 * raw.second);
}

TEST_F(AdditiveTest, BackgroundIsOpenAndDark) {
    AdditiveRun run;
    run.surfels = square_above(0.5f, 2, 8);
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 0.5f);
    const Shot shot(small.scene(), dss_camera({0, 3, 0}, {0, 0, 0}, true, 2), 16, 16);
    splat(shot, run);
    EXPECT_EQ(read("result").at(0, 0), 1);
    EXPECT_LT(read("result").at(8, 8), 1);
    run.parameters.transport.paths = Transport::Paths::indirect;
    splat(shot, run);
    EXPECT_EQ(rgb(read("result"), 0, 0), glm::vec3(0));
    EXPECT_GT(read("result").at(8, 8), 0);
}

}  // namespace
}  // namespace ir::test
