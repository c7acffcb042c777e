#include <cmath>

#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "tests/unit/methods/photon_mapping_filtering_fixture.h"

namespace ir::test {
namespace {

constexpr int temporal_size = 64;

class TemporalFilterTest : public FilteringTest {
  protected:
    Image weight() const { return read("history.weight"); }
};

TEST_F(TemporalFilterTest, WithoutHistoryThePictureIsTheEstimate) {
    const auto shot = wall(temporal_size, temporal_size);
    const auto estimate = Estimate::random(temporal_size, temporal_size, 1);
    auto off = temporal(0.9f);
    off.temporal = false;
    for (const auto& parameters : {temporal(0.9f), off}) {
        filter_once(shot, estimate, parameters);
        const auto image = read("filter.temporal");
        for (int y = 0; y < temporal_size; ++y)
            for (int x = 0; x < temporal_size; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(image.at(x, y, c),
                              estimate.value[static_cast<std::size_t>(y) * temporal_size + x][c]);
    }
}

TEST_F(TemporalFilterTest, EqualFramesGiveTheEqualPicture) {
    for (const auto& shot : {wall(temporal_size, temporal_size), leaf(temporal_size, temporal_size)}) {
        const auto estimate = Estimate::random(temporal_size, temporal_size, 2);
        filter_once(shot, estimate, temporal(0.95f));
        const auto first = read("filter.temporal");
        for (int i = 0; i < 5; ++i) filter(shot, estimate, temporal(0.95f));
        // the history is interpolated between pixels, which rounds
        EXPECT_LE(largest_difference(first, read("filter.temporal")), 2e-6);
        const auto alpha = weight(), valid = read("valid");
        for (int y = 0; y < temporal_size; ++y)
            for (int x = 0; x < temporal_size; ++x)
                ASSERT_NEAR(alpha.at(x, y), valid.at(x, y) > 0 ? 0.95 : 0, 1e-4) << x << ' ' << y;
    }
}

/// n = 64² pixels of independent noise, alpha = 1e-4 on both sides.
TEST_F(TemporalFilterTest, StillPicturesKeepTheExponentialFiltersVariance) {
    const auto shot = wall(temporal_size, temporal_size);
    const float alpha = 0.8f;
    graph().reset_history();
    for (unsigned i = 0; i < 30; ++i)
        filter(shot, Estimate::random(temporal_size, temporal_size, 100 + i), temporal(alpha));
    const auto image = read("filter.temporal");
    const double n = temporal_size * temporal_size;
    double sum = 0, squares = 0;
    for (int y = 0; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            sum += image.at(x, y);
            squares += 1.0 * image.at(x, y) * image.at(x, y);
        }
    const double mean = sum / n, variance = squares / n - mean * mean, z = 3.891;
    const double expected = (1 - alpha) / (1 + alpha) / 12;
    EXPECT_NEAR(mean, 0.5, z * std::sqrt(expected / n));
    // of nearly normal sums: the variance's deviation is √(2/n) of it
    EXPECT_NEAR(variance, expected, z * expected * std::sqrt(2 / n));
    const double mutant = (1 - alpha) / 12;
    EXPECT_GT(std::abs(variance - mutant), z * mutant * std::sqrt(2 / n)) << "the mutant passes";
}

/// A floor seen by a camera that flies along and turns; a linear function of the place is what it is lit by.
struct Flight {
    SmallWorld small;
    Shot before, after;
    static float light(glm::vec3 p) { return 2 + 0.2f * p.x - 0.1f * p.z; }

    static SmallWorld floor() {
        SmallWorld world;
        world.square({0, 0, 0}, {0, 1, 0}, 60);
        return world;
    }
    Flight()
        : small(floor()),
          before(small.scene(), looking({0, 2, 5}, {0, 0, 0}), temporal_size, temporal_size),
          after(small.scene(), looking({0.15f, 2.1f, 4.8f}, {0.2f, 0, 0}), temporal_size, temporal_size) {
        after.previous_view = before.view;
    }
};

TEST_F(TemporalFilterTest, MovingCamerasTakeTheLightAlong) {
    const Flight flight;
    Estimate lit(temporal_size, temporal_size);
    for (int y = 0; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            const auto ray = scene::pixel_ray(flight.before.view, {x + 0.5f, y + 0.5f});
            const float t = -ray.origin_ws.y / ray.direction_ws.y;
            if (t > 0 && t < 60)
                lit.at(x, y) = glm::vec4(Flight::light(ray.origin_ws + t * ray.direction_ws));
        }
    filter_once(flight.before, lit, temporal(0.9f));
    filter(flight.after, Estimate(temporal_size, temporal_size), temporal(0.9f));
    const auto image = read("filter.temporal"), alpha = weight(), position = read("gbuffer.position"),
               velocity = read("gbuffer.velocity");
    int kept = 0;
    float fastest = 0;
    for (int y = 24; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            const glm::vec2 v(velocity.at(x, y, 0), velocity.at(x, y, 1));
            const auto q = glm::vec2(x + 0.5f, y + 0.5f) - v;
            if (q.x < 1 || q.y < 1 || q.x > temporal_size - 1 || q.y > temporal_size - 1) continue;
            fastest = std::max(fastest, glm::length(v));
            ASSERT_GT(alpha.at(x, y), 0.9f * 0.8f) << x << ' ' << y;
            const auto expected = Flight::light(rgb(position, x, y));
            ASSERT_NEAR(image.at(x, y) / alpha.at(x, y), expected, 0.02f) << x << ' ' << y;
            ++kept;
        }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(fastest, 2) << "pixels";
}

TEST_F(TemporalFilterTest, WhatWasOutsideHasNoHistory) {
    const auto before = wall(temporal_size, temporal_size);
    Shot after(before.scene, looking({1, 0, 5}, {1, 0, 0}), temporal_size, temporal_size);
    after.previous_view = before.view;
    const auto ones = Estimate::constant(temporal_size, temporal_size, glm::vec4(1));
    filter_once(before, ones, temporal(0.9f));
    filter(after, Estimate(temporal_size, temporal_size), temporal(0.9f));
    const auto alpha = weight(), velocity = read("gbuffer.velocity");
    const float moved = velocity.at(32, 32, 0);
    EXPECT_LT(moved, -5);
    for (int x = 0; x < temporal_size; ++x) {
        if (x + 0.5f - moved > temporal_size) {
            EXPECT_EQ(alpha.at(x, 32), 0) << x;
        }
        if (x + 0.5f - moved < temporal_size - 1) {
            EXPECT_NEAR(alpha.at(x, 32), 0.9, 1e-3) << x;
        }
    }
}

TEST_F(TemporalFilterTest, WhatWasHiddenHasNoHistory) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 50);
    small.square({0, 0, 2}, {0, 0, 1}, 0.5f);
    const Shot before(small.scene(), looking({0, 0, 5}, {0, 0, 0}), temporal_size, temporal_size);
    Shot after(small.scene(), looking({0.4f, 0, 5}, {0.4f, 0, 0}), temporal_size, temporal_size);
    after.previous_view = before.view;
    filter_once(before, Estimate::constant(temporal_size, temporal_size, glm::vec4(1)), temporal(0.9f));
    filter(after, Estimate(temporal_size, temporal_size), temporal(0.9f));
    const auto alpha = weight(), position = read("gbuffer.position"), image = read("filter.temporal");
    int revealed = 0, kept = 0;
    for (int y = 0; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            const auto p = rgb(position, x, y);
            if (p.z > 1) continue;
            // on the wall, where the ray from the earlier eye crosses the square's plane: 3/5 of the way
            const auto crossing = glm::abs(glm::vec2(p) * (3.0f / 5));
            const float distance = std::max(crossing.x, crossing.y) - 0.5f, pixel = 0.05f;
            const auto clip = before.view.clip_from_world() * glm::vec4(p, 1);
            if (std::abs(clip.x / clip.w) > 0.95f) continue;
            if (distance < -pixel) {
                ++revealed;
                ASSERT_LT(alpha.at(x, y), 1e-3f) << x << ' ' << y;
                ASSERT_LT(image.at(x, y), 1e-3f) << x << ' ' << y;
            } else if (distance > pixel) {
                ++kept;
                ASSERT_NEAR(alpha.at(x, y), 0.9, 2e-3) << x << ' ' << y;
            }
        }
    EXPECT_GT(revealed, 30);
    EXPECT_GT(kept, 1500);
}

TEST_F(TemporalFilterTest, ObjectsThatMoveTakeTheirHistoryAlong) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    small.square({-1.5f, 1.5f, 2}, {0, 0, 1}, 0.01f);  // so that both views have room in depth
    auto scene = small.scene();
    scene::AnimationChannel slide;
    slide.times = {0, 1};
    slide.values = {glm::vec4(0), glm::vec4(0.6f, 0, 1, 0)};  // sideways and towards the camera
    scene.animation.push_back(slide);
    const auto camera = looking({0, 0, 5}, {0, 0, 0});
    const Shot before(scene, camera, temporal_size, temporal_size, 0, 0);
    Shot after(scene, camera, temporal_size, temporal_size, 0.5, 0);
    after.view = before.view;
    after.previous_view = before.view;
    filter_once(before, Estimate::constant(temporal_size, temporal_size, glm::vec4(1)), temporal(0.9f));
    filter(after, Estimate(temporal_size, temporal_size), temporal(0.9f));
    const auto alpha = weight(), position = read("gbuffer.position");
    int inside = 0;
    for (int y = 0; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            const auto p = glm::abs(rgb(position, x, y) - glm::vec3(0.3f, 0, 0));
            if (position.at(x, y, 3) == 0 || p.x > 0.9f || p.y > 0.9f) continue;
            ++inside;
            ASSERT_NEAR(alpha.at(x, y), 0.9, 2e-3) << x << ' ' << y;
        }
    EXPECT_GT(inside, 300);
}

TEST_F(TemporalFilterTest, GhostingIsSeenWhereHistoryDisagrees) {
    const auto shot = wall(temporal_size, temporal_size);
    const auto bright = Estimate::constant(temporal_size, temporal_size, glm::vec4(1));
    filter_once(shot, bright, temporal(0.9f));
    filter(shot, bright, temporal(0.9f));
    EXPECT_EQ(read("history.ghosting").at(32, 32), 0) << "nothing changed";
    filter(shot, Estimate::constant(temporal_size, temporal_size, glm::vec4(0.25f)), temporal(0.9f));
    EXPECT_NEAR(read("history.ghosting").at(32, 32), 0.9 * 0.75, 1e-3);
    graph().reset_history();
    filter(shot, Estimate::random(temporal_size, temporal_size, 7), temporal(0.9f));
    EXPECT_EQ(read("history.ghosting").at(32, 32), 0) << "no history";
}

TEST_F(TemporalFilterTest, HistoryWithGhostsCountsLess) {
    const auto shot = wall(temporal_size, temporal_size);
    auto parameters = temporal(0.9f);
    parameters.reject_ghosts = true;
    filter_once(shot, Estimate::constant(temporal_size, temporal_size, glm::vec4(1)), parameters);
    filter(shot, Estimate::constant(temporal_size, temporal_size, glm::vec4(0.25f)), parameters);
    const float kept = 0.9f * 0.25f;  // this frame explains a quarter
    EXPECT_NEAR(read("filter.temporal").at(32, 32), 0.25 + kept * 0.75, 1e-3);
    EXPECT_NEAR(read("history.length").at(32, 32), 1 + 0.25, 1e-3);
}

/// Means of the first frames: a warm-up below its weight's limit, and progressive pictures without one.
TEST_F(TemporalFilterTest, FewFramesCountTheSame) {
    const auto shot = wall(temporal_size, temporal_size);
    auto warm = temporal(0.95f), progressive = temporal(0.5f);
    warm.warm_up = true;
    progressive.accumulation = pm::Accumulation::progressive;
    for (const auto& parameters : {warm, progressive}) {
        graph().reset_history();
        std::vector<double> mean(std::size_t{temporal_size} * temporal_size);
        const int frames = 8;
        for (unsigned i = 0; i < frames; ++i) {
            const auto estimate = Estimate::random(temporal_size, temporal_size, 30 + i);
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += estimate.value[k].g / frames;
            filter(shot, estimate, parameters);
        }
        const auto image = read("filter.temporal"), length = read("history.length");
        double most = 0;
        for (int y = 0; y < temporal_size; ++y)
            for (int x = 0; x < temporal_size; ++x) {
                most = std::max(most, std::abs(image.at(x, y, 1) -
                                               mean[static_cast<std::size_t>(y) * temporal_size + x]));
                ASSERT_NEAR(length.at(x, y), frames, 2e-3);
            }
        EXPECT_LT(most, 2e-4) << "the wall's depth differs by rounding, which costs history a ten-thousandth";
    }
}

TEST_F(TemporalFilterTest, ProgressivePicturesBeginAgainWhereAnythingMoves) {
    const auto before = wall(temporal_size, temporal_size);
    Shot after(before.scene, looking({0.1f, 0, 5}, {0.1f, 0, 0}), temporal_size, temporal_size);
    after.previous_view = before.view;
    auto parameters = temporal(0.9f);
    parameters.accumulation = pm::Accumulation::progressive;
    filter_once(before, Estimate::constant(temporal_size, temporal_size, glm::vec4(1)), parameters);
    filter(after, Estimate::constant(temporal_size, temporal_size, glm::vec4(0.25f)), parameters);
    EXPECT_EQ(read("filter.temporal").at(32, 32), 0.25f);
    EXPECT_EQ(read("history.length").at(32, 32), 1);
}

/// Two walls that meet at x = 0, the right one two metres farther away.
Shot step() {
    SmallWorld small;
    small.square({-50, 0, 0}, {0, 0, 1}, 50);
    small.square({50, 0, -2}, {0, 0, 1}, 50);
    return {small.scene(), looking({0, 0, 5}, {0, 0, 0}), temporal_size, temporal_size};
}

/// A linear ramp over the slanted floor of a Flight at low resolution, or light on the near wall of step().
class UpSamplingTest : public FilteringTest {
  protected:
    /// `light` at the middle of the pixel that each texel is for, by its depth along the view axis.
    template <class Light>
    Estimate estimate_of(const Shot& shot, int divisor, Light light) {
        run_gbuffer(shot);
        const auto position = read("gbuffer.position");
        Estimate e(temporal_size, temporal_size, divisor);
        for (int y = 0; y < e.height; ++y)
            for (int x = 0; x < e.width; ++x) {
                const auto pixel = glm::ivec2(x, y) * divisor + pm::pixel_of_texel(divisor);
                const bool is_seen = position.at(pixel.x, pixel.y, 3) > 0;
                const auto p_vs = shot.view.view_from_world * glm::vec4(rgb(position, pixel.x, pixel.y), 1);
                e.at(x, y) = glm::vec4(light(pixel.x + 0.5f, pixel.y + 0.5f, is_seen ? -p_vs.z : 1e9f));
            }
        return e;
    }
    static float ramp(float x, float y) { return 1 + 0.02f * x + 0.01f * y; }
};

TEST_F(UpSamplingTest, RampsStayRamps) {
    const Shot floor = Flight().before;
    for (const auto& shot : {floor, wall(temporal_size, temporal_size)})
        for (const int divisor : {2, 4}) {
            const auto low = estimate_of(shot, divisor, [](float x, float y, float) { return ramp(x, y); });
            filter_once(shot, low, temporal(0.9f));
            const auto image = read("filter.temporal"), valid = read("valid");
            for (int y = 28; y < temporal_size - divisor; ++y)
                for (int x = divisor; x < temporal_size - divisor; ++x)
                    if (valid.at(x, y) > 0) {
                        ASSERT_NEAR(image.at(x, y), ramp(x + 0.5f, y + 0.5f), 2e-4f) << x << ' ' << y;
                    }
        }
}

TEST_F(UpSamplingTest, NothingLeaksOverEdgesOfDepthAsBilinearLookUpsDo) {
    const auto shot = step();
    for (const int divisor : {2, 4}) {
        const auto low =
            estimate_of(shot, divisor, [](float, float, float depth) { return depth < 6 ? 1.0f : 0.0f; });
        filter_once(shot, low, temporal(0.9f));
        const auto image = read("filter.temporal"), position = read("gbuffer.position");
        double most = 0, bilinear = 0;
        for (int y = 8; y < temporal_size - 8; ++y)
            for (int x = 8; x < temporal_size - 8; ++x) {
                const float expected = rgb(position, x, y).z > -1 ? 1 : 0;
                most = std::max(most, 1.0 * std::abs(image.at(x, y) - expected));
                const float u = float(x - pm::pixel_of_texel(divisor)) / divisor;
                const int i = static_cast<int>(std::floor(u)), j = y / divisor;
                const float f = u - i, mixed = (1 - f) * low.value[j * low.width + i].r +
                                               f * low.value[j * low.width + i + 1].r;
                bilinear = std::max(bilinear, 1.0 * std::abs(mixed - expected));
            }
        EXPECT_LT(most, 1e-3) << divisor;
        EXPECT_GT(bilinear, 0.2) << "the mutant passes";
        RecordProperty("bilinear_leak_" + std::to_string(divisor), std::to_string(bilinear));
    }
}

/// Bilinear look-ups by depth alone would mix the two: it is the same where they meet.
TEST_F(UpSamplingTest, NothingLeaksOverCreases) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 5);
    small.square({0, 0, 0}, {0, 1, 0}, 5);
    const Shot shot(small.scene(), looking({0, 3, 4}, {0, 0, 0}), temporal_size, temporal_size);
    run_gbuffer(shot);
    const auto normal = read("gbuffer.geometric_normal");
    for (const int divisor : {2, 4}) {
        Estimate low(temporal_size, temporal_size, divisor);
        for (int y = 0; y < low.height; ++y)
            for (int x = 0; x < low.width; ++x) {
                const auto pixel = glm::ivec2(x, y) * divisor + pm::pixel_of_texel(divisor);
                low.at(x, y) = glm::vec4(normal.at(pixel.x, pixel.y, 1) > 0.5f ? 1 : 0);
            }
        filter_once(shot, low, temporal(0.9f));
        const auto image = read("filter.temporal");
        int lit = 0;
        for (int y = 8; y < temporal_size - 8; ++y)
            for (int x = 8; x < temporal_size - 8; ++x) {
                const bool is_floor = normal.at(x, y, 1) > 0.5f;
                ASSERT_NEAR(image.at(x, y), is_floor ? 1 : 0, 1e-3) << x << ' ' << y << ' ' << divisor;
                lit += is_floor;
            }
        EXPECT_GT(lit, 500);
        EXPECT_LT(lit, 48 * 48 - 500);
    }
}

/// A strip of one or two pixels, none of them one that a texel is for.
TEST_F(UpSamplingTest, PixelsThatNoTexelIsForTakeTheOneThatFitsBest) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 50);
    small.square({0.05f, 0, 1}, {0, 0, 1}, 0.04f);
    const Shot shot(small.scene(), looking({0, 0, 5}, {0, 0, 0}), temporal_size, temporal_size);
    const auto low =
        estimate_of(shot, 4, [](float, float, float depth) { return depth < 4.5f ? 5.0f : 1.0f; });
    for (const auto& texel : low.value) ASSERT_EQ(texel.r, 1) << "a texel is for the strip";
    filter_once(shot, low, temporal(0.9f));
    const auto image = read("filter.temporal"), position = read("gbuffer.position");
    int thin = 0;
    for (int y = 0; y < temporal_size; ++y)
        for (int x = 0; x < temporal_size; ++x) {
            ASSERT_NEAR(image.at(x, y), 1, 1e-5) << x << ' ' << y;
            thin += position.at(x, y, 2) > 0.5f;
        }
    EXPECT_GT(thin, 0);
}

}  // namespace
}  // namespace ir::test
