// What explains a pixel is what the framebuffer holds; what explains a surfel is what it won.
#include "tests/unit/methods/dss_visible_fixture.h"

namespace ir::test {
namespace {

constexpr int dss_size = 48, samples = 3, levels = 4;

class DssExplained : public VisibleTest {
  protected:
    DssExplained() {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> unit(-1, 1);
        for (int i = 0; i < 600; ++i)
            run_.surfels.push_back(
                disc({1.5f * unit(random), 0.8f + 0.9f * unit(random), 1.5f * unit(random)},
                     random_direction(random), 0.12f, static_cast<std::uint32_t>(i)));
        run_.parameters = visible_parameters(samples, levels, 0, 0.3f);
        run_.parameters.coverage = 2;
        run_.wanted = {"splats.*", "bounce.distance"};
    }

    Shot shot() const { return floor_shot(dss_size); }

    void explain(const Shot& view, glm::ivec2 pixel, int surfel = 0) {
        auto inputs = view.inputs();
        inputs.inspection = {pixel.x, pixel.y, {{"surfel", surfel}}};
        graph::FrameOptions options;
        options.wanted = run_.wanted;
        ASSERT_TRUE(graph().explain(method(run_), {}, inputs, options));
    }

    VisibleRun run_;
};

TEST_F(DssExplained, TheWinnersFoundAreTheWinnersStored) {
    const auto view = shot();
    for (const auto shells : {dss::Shells::full_discs, dss::Shells::shells}) {
        run_.parameters.shells = shells;
        splat(view, run_);
        std::vector<Image> nearest, hit_levels, distances;
        for (int s = 0; s < samples; ++s) {
            nearest.push_back(read("splats.nearest", s));
            hit_levels.push_back(read("splats.hit_level", s));
            distances.push_back(read("bounce.distance", s));
        }
        int hits = 0, ranks[8] = {};
        for (int i = 0; i < 40; ++i) {
            const glm::ivec2 pixel(i * 17 % dss_size, i * 29 % dss_size);
            explain(view, pixel);
            const auto sums = elements<dss::LevelSum>("splats.explain.levels");
            ASSERT_EQ(sums.size(), std::size_t(samples * levels));
            std::size_t covered = 0;
            for (const auto& sum : sums) {
                EXPECT_EQ(sum.found, sum.kept);
                EXPECT_EQ(sum.found_z, sum.kept_z);
                const auto all = sum.outside + sum.missed + sum.too_far + sum.refused + sum.hits;
                EXPECT_EQ(all, sum.splats);
                covered += all - sum.outside;
                const auto s = std::size_t(sum.sample);
                if (!sum.nearest) continue;
                EXPECT_EQ(float(sum.level), hit_levels[s].at(pixel.x, pixel.y, 0));
                EXPECT_EQ(float(sum.found), nearest[s].at(pixel.x, pixel.y, 0));
                ++hits;
            }
            const auto candidates = elements<dss::SplatCandidate>("splats.explain.candidates");
            EXPECT_EQ(candidates.size(), covered);
            for (const auto& c : candidates) {
                ++ranks[std::size_t(c.outcome)];
                if (c.outcome != dss::SplatOutcome::wins) continue;
                EXPECT_EQ(float(c.surfel), nearest[c.sample].at(pixel.x, pixel.y, 0));
                EXPECT_FLOAT_EQ(c.distance, distances[c.sample].at(pixel.x, pixel.y, 0));
            }
        }
        EXPECT_GT(hits, 40);
        EXPECT_EQ(ranks[std::size_t(dss::SplatOutcome::wins)], hits);
        for (const auto outcome : {dss::SplatOutcome::missed, dss::SplatOutcome::refused, dss::SplatOutcome::hit,
                                   dss::SplatOutcome::level})
            EXPECT_GT(ranks[std::size_t(outcome)], 0) << int(outcome);
    }
}

TEST_F(DssExplained, ATableThatStartsTooSmallGrows) {
    const auto view = shot();
    run_.inspection = {20, 20, {}};
    splat(view, run_);
    const auto whole = elements<dss::SplatCandidate>("splats.explain.candidates");
    EXPECT_GT(whole.size(), 20u);
    run_.initial_capacity = 1e-3;
    splat(view, run_);
    const auto grown = elements<dss::SplatCandidate>("splats.explain.candidates");
    ASSERT_EQ(grown.size(), whole.size());
    EXPECT_EQ(std::memcmp(grown.data(), whole.data(), sizeof(whole[0]) * whole.size()), 0);
}

TEST_F(DssExplained, ASurfelsSplatsAreCountedWhereTheyWon) {
    const auto view = shot();
    splat(view, run_);
    int wins = 0;
    for (const int surfel : {1, 77, 300, 600}) {
        explain(view, {-1, -1}, surfel);
        int won = 0;
        for (int s = 0; s < samples; ++s)
            for (const float winner : read("splats.nearest", s).pixels) won += winner == float(surfel);
        const auto sums = elements<dss::SurfelSum>("splats.explain.surfel");
        ASSERT_EQ(sums.size(), std::size_t(levels));
        for (std::size_t l = 0; l < sums.size(); ++l) {
            const auto& sum = sums[l];
            EXPECT_EQ(sum.surfel, std::uint32_t(surfel));
            EXPECT_GE(sum.splats, sum.hits);
            EXPECT_GE(sum.hits, sum.level_wins);
            EXPECT_GE(sum.level_wins, sum.wins);
            EXPECT_FLOAT_EQ(sum.radius, std::ldexp(0.12f * std::sqrt(2.0f), int(l)));
            const auto cover = read("splats.explain.cover", int(l));
            EXPECT_EQ(std::count(cover.pixels.begin(), cover.pixels.end(), 7.0f) > 0, sum.wins > 0);
            won -= int(sum.wins);
            wins += int(sum.wins);
        }
        EXPECT_EQ(won, 0);
    }
    EXPECT_GT(wins, 0);
}

TEST_F(DssExplained, TheSurfelUnderTheCursorIsTheNearest) {
    run_.surfels = discs_of_square({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 2, 8);
    run_.wanted.push_back("gbuffer.position");
    const auto view = shot();
    splat(view, run_);
    const auto positions = read("gbuffer.position");
    for (const auto pixel : {glm::ivec2(3, 5), glm::ivec2(40, 22)}) {
        explain(view, pixel);
        const auto sum = elements<dss::SurfelSum>("splats.explain.surfel").at(0);
        const auto p = rgb(positions, pixel.x, pixel.y);
        EXPECT_LE(std::abs(sum.centre[0] - p.x), 0.25f);
        EXPECT_LE(std::abs(sum.centre[2] - p.z), 0.25f);
    }
    explain(view, {-1, -1});
    EXPECT_TRUE(elements<dss::SurfelSum>("splats.explain.surfel").empty());
    EXPECT_TRUE(elements<dss::SplatCandidate>("splats.explain.candidates").empty());
}

}  // namespace
}  // namespace ir::test
