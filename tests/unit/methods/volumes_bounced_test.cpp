// Ambient occlusion volumes with visibility against a closed form; masks; what explains a pixel.
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>

#include "tests/unit/methods/volumes_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

class VolumesBouncedTest : public VolumesTest {};

/// Accessibility at distance d from an endless wall at right angles, with t = d / d_max < 1.
double corner_accessibility(double t) {
    return 1 - (std::acos(t) - t * std::sqrt(1 - t * t)) / std::numbers::pi;
}

TEST_F(VolumesBouncedTest, NearACornerTheMeanIsTheClosedForm) {
    // 16 independent rays of each of n pixels; published, the estimator has no bias. Two-sided, alpha = 1e-4.
    // The mutant is another reach.
    const Shot shot("builtin:corner?size=4", "wall", 64, 128);
    auto settings = bounced_volumes(0.5, 16);
    settings["estimator"] = std::string("published");
    settings["spread"] = std::string("independent");
    const auto statistic = [&](double reach) {
        settings["max_distance"] = reach;
        const auto image = render(shot, settings);
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        double sum = 0, squares = 0;
        int n = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = image.width / 4; x < 3 * image.width / 4; ++x) {
                const double t = position.at(x, y, 1) / 0.5;
                if (normal.at(x, y, 0) < 0.5f || t > 0.95) continue;
                const double error = image.at(x, y) - corner_accessibility(t);
                sum += error;
                squares += error * error;
                ++n;
            }
        EXPECT_GT(n, 200);
        return std::abs(sum) / std::sqrt(squares);
    };
    EXPECT_LT(statistic(0.5), 3.9);
    EXPECT_GT(statistic(0.4), 3.9);
}

TEST_F(VolumesBouncedTest, RaysPassThroughTheHolesOfMasks) {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    world.square({0, 0.3f, 0}, {0, -1, 0}, 1, SmallWorld::masked);  // a quarter is a hole
    const Shot shot(world.scene(), volumes_camera({1.9f, 0.2f, 1.9f}, {0, 0, 0}), 48, 32);
    render(shot, bounced_volumes(1, 4));
    const auto position = read("gbuffer.position");
    const auto& plate = shot.world.positions;
    int through = 0, blocked = 0;
    for (int layer = 0; layer < 4; ++layer) {
        const auto direction = read("bounce.directions", layer), winner = read("volumes.winner", layer);
        for (int y = 0; y < winner.height; ++y)
            for (int x = 0; x < winner.width; ++x) {
                const auto p = rgb(position, x, y), d = rgb(direction, x, y);
                if (std::abs(p.y) > 1e-3f || d.y < 0.4f) continue;
                const auto q = p + (0.3f - p.y) / d.y * d;
                const float u = glm::dot(q - plate[4], plate[5] - plate[4]) / 4,
                            v = glm::dot(q - plate[4], plate[7] - plate[4]) / 4;
                if (std::min(u, v) < 0.01f || std::max(u, v) > 0.99f || std::abs(u - 0.5f) < 0.01f ||
                    std::abs(v - 0.5f) < 0.01f)
                    continue;
                const bool hole = u < 0.5f && v < 0.5f;
                ASSERT_EQ(winner.at(x, y) > 2, !hole) << u << " " << v;
                ++(hole ? through : blocked);
            }
    }
    EXPECT_GT(through, 20);
    EXPECT_GT(blocked, 60);
}

TEST_F(VolumesBouncedTest, TheSameSeedGivesTheSameBitsAndAnotherSeedDoesNot) {
    const Shot shot("builtin:cornell", "", 32, 32);
    const auto a = render(shot, bounced_volumes(1, 2), "accessibility", 3),
               b = render(shot, bounced_volumes(1, 2), "accessibility", 3),
               c = render(shot, bounced_volumes(1, 2), "accessibility", 4);
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_NE(a.pixels, c.pixels);
}

TEST_F(VolumesBouncedTest, WithoutALimitAllThatIsMetCloses) {
    const Shot shot("builtin:cornell", "", 24, 24);
    const auto image = render(shot, bounced_volumes(0, 4));
    EXPECT_FALSE(report.messages.empty());
    const auto farther = render(shot, bounced_volumes(100, 4));
    EXPECT_TRUE(report.messages.empty());
    EXPECT_EQ(image.pixels, farther.pixels);
}

/// At edges that triangles share either may be named.
TEST_F(VolumesBouncedTest, TheHostMeetsTheSame) {
    constexpr int samples = 3, size = 40;
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 2);
    world.square({0, 0.3f, 0}, {0, -1, 0}, 1, SmallWorld::masked);
    world.add_soup(40, 5);
    const Shot shot(world.scene(), volumes_camera({2.5f, 1.2f, 2.5f}, {0, 0, 0}), size, size);
    for (const double reach : {0.4, 0.0}) {
        std::vector<Image> winners[2], distances[2], depths[2];
        for (const auto processor : {Processor::gl, Processor::host}) {
            on = processor;
            render(shot, bounced_volumes(reach, samples));
            const bool is_host = on == Processor::host;
            EXPECT_EQ(report.messages.empty(), is_host || reach > 0);
            for (int layer = 0; layer < samples; ++layer) {
                winners[is_host].push_back(read("volumes.winner", layer));
                distances[is_host].push_back(read("bounce.distance", layer));
                depths[is_host].push_back(read("volumes.depth", layer));
            }
        }
        int met = 0, different = 0;
        for (std::size_t layer = 0; layer < samples; ++layer)
            for (std::size_t i = 0; i < winners[0][layer].pixels.size(); ++i) {
                met += winners[0][layer].pixels[i] != 0;
                different +=
                    winners[0][layer].pixels[i] != winners[1][layer].pixels[i] ||
                    std::abs(distances[0][layer].pixels[i] - distances[1][layer].pixels[i]) > 1e-4f ||
                    std::abs(depths[0][layer].pixels[i] - depths[1][layer].pixels[i]) > 1e-3f;
            }
        EXPECT_GT(met, size * size * samples / 20);
        EXPECT_LE(different, size * size * samples / 500);
    }
}

struct Explained {
    std::uint32_t triangle, hits, won;
    float form_factor, weight, occlusion, distance;
};

class VolumesExplainTest : public VolumesBouncedTest {
  protected:
    std::vector<Explained> explained() {
        const std::string key = "volumes.explain.triangles";
        std::uint64_t count = 0;
        for (const auto& resource : report.resources)
            if (resource.key == key) count = resource.elements;
        const auto bytes = graph().read_buffer(key).value();
        std::vector<Explained> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t words[14];
            std::memcpy(words, bytes.data() + i * sizeof(words), sizeof(words));
            float floats[14];
            std::memcpy(floats, words, sizeof(words));
            result[i] = {words[7], words[11], words[12], floats[8], floats[9], floats[10], floats[13]};
        }
        return result;
    }
};

TEST_F(VolumesExplainTest, WhatExplainsAPixelAddsUpToItsSum) {
    const Shot shot("builtin:cornell", "", 32, 32);
    for (const char* falloff : {"hard", "smooth"})
        for (const glm::ivec2 pixel : {glm::ivec2(16, 28), glm::ivec2(3, 15), glm::ivec2(20, 25)}) {
            const auto image = render(shot, additive_volumes(0.8, "front", falloff), "volumes.sum", 7,
                                      {pixel.x, pixel.y, {}});
            double sum = 0;
            std::uint32_t last = 0;
            const auto all = explained();
            EXPECT_FALSE(all.empty());
            for (const auto& e : all) {
                EXPECT_NEAR(e.occlusion, e.form_factor * e.weight, 1e-6);
                EXPECT_TRUE(sum == 0 || e.triangle > last);  // in the order of the triangles
                last = e.triangle;
                sum += e.occlusion;
            }
            EXPECT_NEAR(sum, image.at(pixel.x, pixel.y), 1e-5);
            EXPECT_EQ(static_cast<double>(all.size()), read("volumes.within").at(pixel.x, pixel.y));
        }
}

TEST_F(VolumesExplainTest, WinnersAreThoseOfTheBouncedZBuffer) {
    const Shot shot("builtin:cornell", "", 32, 32);
    const glm::ivec2 pixel(16, 28);
    render(shot, bounced_volumes(0.8, 8), "accessibility", 7, {pixel.x, pixel.y, {}});
    std::map<std::uint32_t, std::uint32_t> won;
    for (int layer = 0; layer < 8; ++layer) {
        const auto winner = static_cast<std::uint32_t>(read("volumes.winner", layer).at(pixel.x, pixel.y));
        if (winner) ++won[winner - 1];
    }
    EXPECT_FALSE(won.empty());
    for (const auto& e : explained()) {
        EXPECT_EQ(e.won, won.count(e.triangle) ? won.at(e.triangle) : 0u) << e.triangle;
        EXPECT_GE(e.hits, e.won);
        EXPECT_EQ(e.hits > 0, e.distance > 0);
        won.erase(e.triangle);
    }
    EXPECT_TRUE(won.empty());
}

}  // namespace
}  // namespace ir::test
