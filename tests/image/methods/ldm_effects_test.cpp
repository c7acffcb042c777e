// What ldm-ao shows of each direction: by how much the picture changes where it is left out.
#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

graph::FrameOptions only(std::vector<std::string> keys) {
    graph::FrameOptions options;
    options.wanted = std::move(keys);
    return options;
}

const graph::FrameOptions effects_alone =
    only({"ldm.effects", "ldm.explain.effects", "ldm.explain.hits", "ldm.directions", "gbuffer.normal"});

/// By region, from what each direction contributes: accessibility without the direction minus that with it.
std::vector<double> changes_without(const Elements& hits, glm::dvec3 normal) {
    double all = 0, open = 0;
    std::vector<double> cosines;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        cosines.push_back(std::max(0.0, glm::dot(glm::normalize(normal), hits.vector(i, "centre"))));
        all += cosines.back();
        open += hits.number(i, "contribution");
    }
    std::vector<double> changes;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const double rest = (open - hits.number(i, "contribution")) / (1 - cosines[i] / all);
        changes.push_back(cosines[i] > 0 ? rest - open : 0);
    }
    return changes;
}

TEST_F(LdmExplain, EffectsAreWhatLeavingADirectionOutChanges) {
    load("builtin:cornell");
    size = 5;
    for (const std::string falloff : {"hard", "smooth"}) {
        const auto settings = maps(37, 60, {{"max_distance", 0.3}, {"falloff", falloff}});
        render(settings, choose(5, 0, 0), effects_alone);
        std::vector<double> sum(2 * 37), squares(2 * 37);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                ASSERT_TRUE(explain(settings, choose(5, x, y), effects_alone));
                const auto expected =
                    changes_without(elements("ldm.explain.hits"), vector_at("gbuffer.normal", x, y));
                const auto effects = elements("ldm.explain.effects");
                ASSERT_EQ(effects.size(), expected.size());
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    EXPECT_NEAR(effects.number(i, "change"), expected[i], 2e-6);
                    EXPECT_NEAR(effects.number(i, "effect"), std::abs(expected[i]), 2e-6);
                    sum[i] += expected[i];
                    squares[i] += expected[i] * expected[i];
                }
            }
        const auto effects = elements("ldm.effects"), directions = elements("ldm.directions");
        ASSERT_EQ(effects.size(), sum.size());
        double largest = 0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            EXPECT_EQ(effects.vector(i, "centre"), directions.vector(i, "centre"));
            EXPECT_EQ(effects.integer(i, "side"), directions.integer(i, "side"));
            EXPECT_NEAR(effects.number(i, "change"), sum[i] / (size * size), 2e-6);
            EXPECT_NEAR(effects.number(i, "effect"), std::sqrt(squares[i] / (size * size)), 2e-6);
            largest = std::max(largest, std::sqrt(squares[i] / (size * size)));
        }
        EXPECT_GT(largest, 0.005);
    }
}

TEST_F(LdmExplain, EffectsOfBatchesTurnedSetsAndLargePictures) {
    load("builtin:cornell");
    const auto settings = maps(64, 100);
    render(settings, choose(0, 16, 28), effects_alone);
    const auto whole = elements("ldm.effects"), of_pixel = elements("ldm.explain.effects");
    EXPECT_TRUE(whole.has("colatitude"));
    graph::FrameOptions options = effects_alone;
    options.memory_budget = report.peak_memory_bytes * 8 / 10;
    reset();
    render(settings, choose(0, 16, 28), options);
    EXPECT_GT(report.counters["batches"], 1);
    EXPECT_EQ(elements("ldm.effects").bytes(), whole.bytes());
    EXPECT_EQ(elements("ldm.explain.effects").bytes(), of_pixel.bytes());
    reset();
    render(maps(64, 100, {{"progressive", true}}), choose(0, 16, 28), effects_alone);
    EXPECT_FALSE(elements("ldm.effects").has("colatitude"));
    // A grid over a large picture shows about the same as a small one.
    reset();
    size = 160;
    render(settings, choose(0), effects_alone);
    const auto large = elements("ldm.effects");
    EXPECT_EQ(elements("ldm.explain.effects").size(), 0u);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        difference += std::abs(large.number(i, "effect") - whole.number(i, "effect"));
        sum += whole.number(i, "effect");
    }
    EXPECT_LT(difference, 0.1 * sum);
}

TEST_F(LdmExplain, AnOpenPlaneNeedsNoneOfItsDirections) {
    load("builtin:plane");
    render(maps(32, 50), choose(0), effects_alone);
    const auto effects = elements("ldm.effects");
    ASSERT_EQ(effects.size(), 64u);
    for (std::size_t i = 0; i < effects.size(); ++i) EXPECT_NEAR(effects.number(i, "effect"), 0, 1e-6) << i;
}

}  // namespace
}  // namespace ir::test
