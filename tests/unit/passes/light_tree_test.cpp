// Choosing among many lights.
#include "renderers/passes/lights/light_tree.h"

#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

using passes::LightBounds;
using passes::LightReceiver;
using passes::LightTree;

float probability(const LightTree& tree, glm::vec3 at, glm::vec3 normal, std::uint32_t light) {
    LightReceiver receiver(at, normal);
    return tree.probability(receiver, light);
}

/// Small facets and points at random in [-1, 1]³, some of them far brighter than others.
std::vector<LightBounds> random_lights(int n, unsigned seed) {
    Uniform uniform(seed);
    std::vector<LightBounds> lights;
    for (int i = 0; i < n; ++i) {
        LightBounds light;
        const float x = uniform.number(), y = uniform.number(), z = uniform.number();
        light.min = light.max = 2.0f * glm::vec3(x, y, z) - 1.0f;
        light.intensity = std::exp(6 * uniform.number());
        light.axis = glm::normalize(glm::vec3(y - 0.5f, z - 0.5f, 0.1f + x));
        light.cos_normals = i % 3 == 0 ? -1.0f : 1.0f;
        light.two_sided = i % 3 == 1;
        if (i % 3 > 0) light.max += glm::vec3(0.02f);
        lights.push_back(light);
    }
    return lights;
}

TEST(LightTreeTest, ChoicesFollowTheirProbabilities) {
    // n = 200,000; χ² with α = 1e-4 over 60 lights, at places within, aside and on a plane.
    const auto lights = random_lights(60, 4);
    const LightTree tree(lights);
    for (const glm::vec3 normal : {glm::vec3(0), up})
        for (const glm::vec3 at : {glm::vec3(0.1f, 0, -0.2f), glm::vec3(3, -1, 0.5f)}) {
            std::vector<double> counts(lights.size());
            Uniform uniform(8);
            const int n = 200000;
            int none = 0;
            for (int i = 0; i < n; ++i) {
                LightReceiver receiver(at, normal);
                const auto choice = tree.choose(receiver, uniform.number());
                if (!choice) {
                    ++none;
                    continue;
                }
                ++counts[choice->light];
                const float again = probability(tree, at, normal, choice->light);
                ASSERT_NEAR(again / choice->probability, 1, 1e-4f);
            }
            double chi2 = 0, twisted = 0, sum = 0;
            int freedom = -1;
            for (std::uint32_t i = 0; i < lights.size(); ++i) {
                const double p = probability(tree, at, normal, i),
                             next = probability(tree, at, normal, (i + 1) % 60);
                sum += p;
                EXPECT_TRUE(p > 0 || counts[i] == 0);
                if (n * p < 5) continue;
                chi2 += (counts[i] - n * p) * (counts[i] - n * p) / (n * p);
                if (next > 0) twisted += (counts[i] - n * next) * (counts[i] - n * next) / (n * next);
                ++freedom;
            }
            EXPECT_NEAR(sum + static_cast<double>(none) / n, 1, 0.01);
            EXPECT_LT(chi2, chi2_limit(freedom));
            EXPECT_GT(twisted, chi2_limit(freedom)) << "mutant: the probability of a neighbour";
        }
}

TEST(LightTreeTest, NothingThatSendsLightIsLeftOut) {
    const auto lights = random_lights(300, 5);
    const LightTree tree(lights);
    Uniform uniform(6);
    for (int i = 0; i < 300; ++i) {
        const float x = uniform.number(), y = uniform.number(), z = uniform.number();
        const auto at = 4.0f * glm::vec3(x, y, z) - 2.0f;
        for (std::uint32_t l = 0; l < lights.size(); ++l) {
            const auto& light = lights[l];
            const auto offset = at - 0.5f * (light.min + light.max);
            const float cosine = glm::dot(glm::normalize(offset), light.axis);
            const bool shines =
                light.cos_normals < 0 || (light.two_sided ? std::abs(cosine) : cosine) > 1e-3f;
            const bool above = offset.y < -1e-3f;
            ASSERT_TRUE(!shines || probability(tree, at, glm::vec3(0), l) > 0);
            ASSERT_TRUE(!shines || !above || probability(tree, at, up, l) > 0);
        }
    }
}

TEST(LightTreeTest, RaysThatMeetALightMayMeetIt) {
    const auto lights = random_lights(300, 7);
    const LightTree tree(lights);
    Uniform uniform(9);
    const auto place = [&] {
        const float x = uniform.number(), y = uniform.number(), z = uniform.number();
        return 4.0f * glm::vec3(x, y, z) - 2.0f;
    };
    int spared = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto from = place();
        spared += !tree.may_meet(from, glm::normalize(place()));
        const auto& light = lights[static_cast<std::size_t>(i) % lights.size()];
        for (const auto& corner : {light.min, light.max})
            ASSERT_TRUE(tree.may_meet(from, glm::normalize(corner - from)));
    }
    EXPECT_GT(spared, 200) << "it says so of all rays";
    EXPECT_FALSE(LightTree({}).may_meet({0, 0, 0}, up));
}

TEST(LightTreeTest, LightsInOnePlaceAndWithoutIntensity) {
    std::vector<LightBounds> lights(5);
    for (auto& light : lights) light.intensity = 1;
    lights[2].intensity = 0;
    const LightTree tree(lights);
    for (const std::uint32_t i : {0u, 1u, 3u, 4u}) {
        EXPECT_NEAR(probability(tree, {0, -1, 0}, up, i), 0.25f, 1e-6f);
        EXPECT_TRUE(std::isfinite(probability(tree, {0, 0, 0}, up, i)));
    }
    EXPECT_EQ(probability(tree, {0, -1, 0}, up, 2), 0);
    EXPECT_TRUE(LightTree({}).empty());
    LightReceiver receiver({0, 0, 0}, up);
    EXPECT_FALSE(LightTree({}).choose(receiver, 0.5));
}

TEST(LightTreeTest, ManyLightsGiveTheirSumWithLittleNoise) {
    // 8,192 small triangles, a plate; n = 20,000. By area alone the deviation of one sample is 4 times the
    // mean.
    LightScene world;
    const int glow = world.emitter(glm::vec3(2));
    constexpr int side = 64;
    constexpr float step = 8.0f / side;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 a(-4 + step * x, 1, -4 + step * y), b(step, 0, 0), c(0, 0, step);
            world.quad(a, a + b, a + b + c, a + c, glow);
        }
    // A square plate of side 8 at distance 0.25 and 1: form factor of four corners.
    const auto& sampler = world.sampler();
    for (const float distance : {0.25f, 1.0f}) {
        const double a = 4 / distance, root = std::sqrt(1 + a * a);
        const double expected = 2 * 4 * a / root * std::atan(a / root);
        const auto e = irradiance(sampler, {0.3f * step, 1 - distance, 0}, up, 20000);
        EXPECT_NEAR(e.mean, expected, 3.891 * e.error + 2e-3 * expected);
        EXPECT_LT(e.error * std::sqrt(20000) / e.mean, 1.0) << distance;
    }
}

}  // namespace
}  // namespace ir::test
