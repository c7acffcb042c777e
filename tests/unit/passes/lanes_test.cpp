// What sixteen samples share a vector for, held against one at a time.
#include <gtest/gtest.h>

#include "renderers/passes/sampling/point_sequence.h"
#include "tests/unit/passes/bsdf_fixture.h"

namespace ir::test {
namespace {

using passes::lane_count;
using passes::Lanes;
using passes::Lanes2;
using passes::Lanes3;
using passes::OpaqueLobes;
using passes::PathSampler;

TEST(Lanes, SamplersGiveTheSameBits) {
    std::vector<PathSampler> samplers;
    for (std::uint32_t i = 0; i < 13; ++i) samplers.emplace_back(0x123456789abcdefu + i / 4, 977 * i);
    for (const std::uint32_t dimension : {0u, 1u, 7u}) {
        Lanes2 pairs;
        PathSampler::pairs(samplers, dimension, pairs);
        for (std::size_t i = 0; i < samplers.size(); ++i) {
            const auto expected = samplers[i].pair(dimension);
            EXPECT_EQ(pairs.x[i], expected.x) << i;
            EXPECT_EQ(pairs.y[i], expected.y) << i;
        }
    }
}

/// With a shading normal of its own, so that light can be above one of the two and below the other.
std::vector<Patch> patches() {
    std::vector<Patch> all;
    for (const auto model : {Materials::lambert, Materials::gltf, Materials::metalness_blend})
        for (const float roughness : {0.1f, 0.5f, 1.0f})
            for (const float metallic : {0.0f, 0.5f, 1.0f}) {
                Patch patch(model);
                patch.surface.roughness = roughness;
                patch.surface.metallic = metallic;
                patch.surface.geometric_normal_ws = patch.direction(0.9f, 2.0f);
                all.push_back(patch);
            }
    return all;
}

/// Looking from above, grazing, and from below the shading normal's horizon.
constexpr float views[] = {0.9f, 0.2f, -0.1f};

glm::vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    const float x = normal(random), y = normal(random);
    return glm::normalize(glm::vec3(x, y, normal(random)));
}

void expect_near(float found, float expected, const char* what) {
    // Roots and quotients of vectors round otherwise; the peak of roughness 0.1 has a height of 3,000.
    EXPECT_NEAR(found, expected, 2e-4f * std::abs(expected) + 1e-5f) << what;
}

TEST(Lanes, OpaqueLobesScatterAsTheBsdf) {
    std::mt19937 random(3);
    for (const auto& patch : patches())
        for (const float view : views) {
            const auto bsdf = patch.bsdf();
            const auto wo = patch.direction(view);
            const auto opaque = bsdf.opaque(wo);
            ASSERT_TRUE(opaque);
            Lanes3 directions;
            for (std::size_t i = 0; i < lane_count; ++i) directions.put(i, random_direction(random));
            OpaqueLobes::Values values;
            opaque->evaluate(directions, values);
            for (std::size_t i = 0; i < lane_count; ++i) {
                const auto expected = bsdf.evaluate_with_pdf(wo, directions.at(i));
                for (int c = 0; c < 3; ++c) expect_near(values.value.at(i)[c], expected.value[c], "value");
                expect_near(values.pdf[i], expected.pdf, "pdf");
            }
        }
}

TEST(Lanes, OpaqueLobesChooseAsTheBsdf) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    int chosen = 0;
    for (const auto& patch : patches())
        for (const float view : views) {
            const auto bsdf = patch.bsdf();
            const auto wo = patch.direction(view);
            Lanes lobes;
            Lanes2 u;
            for (std::size_t i = 0; i < lane_count; ++i)
                lobes[i] = unit(random), u.x[i] = unit(random), u.y[i] = unit(random);
            Lanes3 directions;
            const auto found = bsdf.opaque(wo)->choose(lobes, u, directions);
            for (std::size_t i = 0; i < lane_count; ++i) {
                const auto expected = bsdf.choose(wo, lobes[i], {u.x[i], u.y[i]});
                ASSERT_EQ((found >> i & 1) != 0, expected.has_value());
                if (!expected) continue;
                ++chosen;
                EXPECT_NEAR(glm::distance(directions.at(i), expected->wi), 0, 2e-5f);
            }
        }
    EXPECT_GT(chosen, 500);
}

TEST(Lanes, GlassAndMirrorsAreNotOpaque) {
    Patch mirror;
    mirror.surface.roughness = 0;
    EXPECT_FALSE(mirror.bsdf().opaque(mirror.direction(0.5f)));
    EXPECT_FALSE(glass(0, 0.5f).bsdf().opaque(glass(0).direction(0.5f)));
    mirror.model = Materials::lambert;
    EXPECT_TRUE(mirror.bsdf().opaque(mirror.direction(0.5f)));
}

}  // namespace
}  // namespace ir::test
