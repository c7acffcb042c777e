// What ldm-indirect shows of each direction, and of how a photon was traced.
#include "renderers/methods/ldm-indirect/splatting/host/leave_out.h"
#include "renderers/methods/ldm-indirect/stages.h"
#include "shaders/methods/ldm-indirect/splatting/explain.comp.h"
#include "tests/image/methods/ldm_explain.h"

namespace ir::test {
namespace {

namespace li = methods::ldm_indirect;

class LdmIndirectExplain : public LdmExplain {
  protected:
    std::string id() const override { return "ldm-indirect"; }
    std::string result() const override { return "radiance"; }

    static Settings settings(int directions, const Settings& more = {}) {
        Settings s{{"directions", std::int64_t{directions}},
                   {"resolution", std::int64_t{100}},
                   {"emission", std::int64_t{12}},
                   {"max_bounces", std::int64_t{2}},
                   {"paths", std::string("indirect")}};
        for (const auto& [key, value] : more) s[key] = value;
        return s;
    }
    /// And all maps.
    static Inspection picked(glm::ivec2 pixel) { return choose(Inspection::all, pixel.x, pixel.y); }
    template <class T>
    std::vector<T> all(const std::string& key) const {
        const auto bytes = elements(key).bytes();
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }
    static graph::FrameOptions wanting(std::vector<std::string> keys) {
        graph::FrameOptions options;
        options.wanted = std::move(keys);
        return options;
    }
};

double light_of(const li::FoundPhoton& photon) {
    return 0.2126 * photon.contribution[0] + 0.7152 * photon.contribution[1] +
           0.0722 * photon.contribution[2];
}

/// By region, as "indirect.directions" counts: what the pixel has without the direction, where the others
/// take over what each primary photon would have sent along it, minus what it has.
std::vector<double> changes_without(const std::vector<li::FoundPhoton>& photons,
                                    const std::vector<li::Primary>& primaries,
                                    const std::vector<passes::ldm::MapFrame>& frames) {
    std::vector<double> changes;
    for (std::size_t map = 0; map < frames.size(); ++map)
        for (const int side : {1, -1}) {
            double with = 0, without = 0;
            for (const auto& photon : photons) {
                const auto& p = primaries.at(photon.source);
                const double cosine =
                    side * glm::dot(glm::dvec3(p.shading_ws), glm::dvec3(frames[map].direction));
                const double taken = std::max(cosine, 0.0);
                with += light_of(photon);
                if (photon.map != map || photon.side != side)
                    without += light_of(photon) * p.cosine_sum / (p.cosine_sum - taken);
            }
            changes.push_back(without - with);
        }
    return changes;
}

TEST_F(LdmIndirectExplain, EffectsAreWhatLeavingADirectionOutChanges) {
    load("builtin:cornell");
    size = 5;
    const auto wanted = wanting({"indirect.effects", "indirect.explain.effects", "indirect.explain.photons",
                                 "indirect.primary_photons", "ldm.frames"});
    for (const bool progressive : {false, true}) {
        reset();
        const auto chosen = settings(19, {{"progressive", progressive}});
        render(chosen, picked({0, 0}), wanted);
        const auto primaries = all<li::Primary>("indirect.primary_photons");
        const auto frames = all<passes::ldm::MapFrame>("ldm.frames");
        std::vector<double> sum(2 * 19), squares(2 * 19);
        double largest = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                ASSERT_TRUE(explain(chosen, picked({x, y}), wanted));
                const auto photons = all<li::FoundPhoton>("indirect.explain.photons");
                if (photons.empty()) continue;
                const auto expected = changes_without(photons, primaries, frames);
                const auto effects = all<li::DirectionEffect>("indirect.explain.effects");
                ASSERT_EQ(effects.size(), expected.size());
                double light = 0;
                for (const auto& photon : photons) light += light_of(photon);
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    EXPECT_NEAR(effects[i].change, expected[i], 1e-5 * light) << i;
                    EXPECT_NEAR(effects[i].effect, std::abs(expected[i]), 1e-5 * light) << i;
                    EXPECT_EQ(effects[i].map, i / 2);
                    sum[i] += expected[i];
                    squares[i] += expected[i] * expected[i];
                    largest = std::max(largest, std::abs(expected[i]));
                }
            }
        const auto effects = all<li::DirectionEffect>("indirect.effects");
        ASSERT_EQ(effects.size(), sum.size());
        for (std::size_t i = 0; i < sum.size(); ++i) {
            EXPECT_NEAR(effects[i].change, sum[i] / (size * size), 1e-4 * largest) << i;
            EXPECT_NEAR(effects[i].effect, std::sqrt(squares[i] / (size * size)), 1e-4 * largest) << i;
        }
        EXPECT_GT(largest, 0);
    }
    // A grid over a large picture shows about the same as all of a small one.
    const auto mean_effect = [&](int pixels) {
        reset();
        size = pixels;
        render(settings(128), {}, wanting({"indirect.effects"}));
        double mean = 0;
        for (const auto& effect : all<li::DirectionEffect>("indirect.effects")) mean += effect.effect;
        return mean;
    };
    const double small = mean_effect(40);
    EXPECT_NEAR(mean_effect(80) / small, 1, 0.1);
}

// Where the last cells of the grid would lie beyond the picture, they are its border.
TEST_F(LdmIndirectExplain, EffectsKnowThePicturesBorder) {
    load("builtin:cornell");
    size = 17;  // a grid of 9 × 9, two pixels apart from the second one
    render(settings(1024, {{"resolution", std::int64_t{20}}, {"emission", std::int64_t{4}}}), {},
           wanting({"indirect.effects", "indirect.contributions"}));
    const auto found = all<li::Contribution>("indirect.contributions");
    const auto of_column = [&](std::uint32_t column) {
        return std::ranges::count_if(found, [&](const auto& each) { return each.cell % 9u == column; });
    };
    EXPECT_GT(of_column(7), 0);
    EXPECT_GT(of_column(8), 0);
}

// Of one primary photon: weighed by what the others keep, leaving each direction out in turn changes nothing,
// Σ (S - c) Δ = 0.
TEST(LdmIndirectEffects, OfAllDirectionsCancel) {
    constexpr int maps = 24;
    li::Primary primary{};
    primary.shading_ws = glm::normalize(glm::vec3(0.3f, 0.8f, -0.2f));
    const auto directions = passes::ldm::leopardi_directions(maps);
    double sum = 0;
    for (const auto& d : directions) sum += std::abs(glm::dot(glm::dvec3(primary.shading_ws), d.centre));
    primary.cosine_sum = static_cast<float>(sum);
    std::vector<li::Contribution> contributions;
    for (std::uint32_t map = 0; map < maps; map += 3) {
        const bool along = glm::dot(glm::dvec3(primary.shading_ws), directions[map].centre) > 0;
        contributions.push_back({7, 0, map | (along ? li::leg_along : 0u), 0.1f + 0.05f * float(map)});
    }
    passes::ldm::Options options;
    options.directions = maps;
    const auto effects = li::effects_of_leaving_out(contributions, 1, std::span(&primary, 1), options, 1);
    ASSERT_EQ(effects.size(), 2u * maps);
    double weighed = 0, brighter = 0;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        const double cosine = glm::dot(glm::dvec3(primary.shading_ws), directions[i / 2].centre);
        if ((effects[i].side > 0) == (cosine > 0))
            weighed += (sum - std::abs(cosine)) * effects[i].change;
        else
            EXPECT_EQ(effects[i].change, 0) << "below the surface";
        brighter += std::max(0.0f, effects[i].change);
    }
    EXPECT_NEAR(weighed, 0, 1e-5);
    EXPECT_GT(brighter, 0.1);
    std::ranges::reverse(contributions);
    const auto again = li::effects_of_leaving_out(contributions, 1, std::span(&primary, 1), options, 2);
    for (std::size_t i = 0; i < effects.size(); ++i) EXPECT_EQ(again[i].change, effects[i].change);
    EXPECT_TRUE(li::effects_of_leaving_out({}, 0, {}, options, 1).front().effect == 0);
}

TEST_F(LdmIndirectExplain, ThePhotonsTraceIsTheWalkThroughItsMap) {
    load("builtin:cornell");
    size = 24;
    const auto wanted =
        wanting({"indirect.explain.trace", "indirect.explain.photons", "ldm.explain.*", "ldm.frames"});
    const auto chosen = settings(48, {{"landing", std::string("centre")}});
    render(chosen, {}, wanted);
    EXPECT_EQ(elements("indirect.explain.trace").size(), 0u);
    EXPECT_EQ(elements("ldm.explain.walk").size(), 0u);
    int agree = 0, tested = 0;
    for (const glm::ivec2 pixel : {glm::ivec2(12, 20), glm::ivec2(4, 14), glm::ivec2(18, 10)}) {
        ASSERT_TRUE(explain(chosen, picked(pixel), wanted));
        const auto photons = all<li::FoundPhoton>("indirect.explain.photons");
        ASSERT_FALSE(photons.empty());
        const auto trace = elements("indirect.explain.trace"), walk = elements("ldm.explain.walk"),
                   entries = elements("ldm.explain.entries");
        ASSERT_EQ(trace.size(), 2u);
        EXPECT_EQ(std::uint32_t(trace.integer(0, "photon")), photons[0].photon);
        EXPECT_EQ(std::uint32_t(trace.integer(0, "map")), photons[0].map);
        EXPECT_EQ(trace.integer(1, "role"), 1);
        ASSERT_GE(walk.size(), 2u);
        ASSERT_GT(entries.size(), 0u);
        EXPECT_EQ(elements("ldm.explain.texel").size(), 1u);
        const auto frame = all<passes::ldm::MapFrame>("ldm.frames").at(photons[0].map);
        const double texel =
            std::max(glm::length(glm::vec3(frame.step_u)), glm::length(glm::vec3(frame.step_v)));
        // Line 0 runs along the map's direction, line 1 against it.
        const std::size_t line = photons[0].side > 0 ? 0 : 1;
        EXPECT_EQ(walk.integer(line, "above"), 1);
        EXPECT_EQ(walk.integer(1 - line, "above"), 0);
        EXPECT_EQ(walk.integer(line, "hit"), 1);
        EXPECT_LT(glm::distance(walk.vector(line, "start"), trace.vector(0, "start")), 1e-6);
        // The camera's view moves a landing as far as texels explain it.
        EXPECT_NEAR(glm::distance(walk.vector(line, "start"), walk.vector(line, "end")),
                    trace.number(0, "distance"), 10 * texel);
        agree += std::abs(trace.number(0, "distance") - trace.number(1, "distance")) < 3 * texel;
        ++tested;
        // Of a map that is chosen: its own brightest, if it has one there.
        ASSERT_TRUE(explain(chosen, choose(static_cast<int>(photons.back().map), pixel.x, pixel.y), wanted));
        EXPECT_EQ(std::uint32_t(elements("indirect.explain.trace").integer(0, "map")), photons.back().map);
    }
    EXPECT_GE(agree, tested - 1);
}

}  // namespace
}  // namespace ir::test
