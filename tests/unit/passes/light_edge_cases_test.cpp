// What emits nothing, and places where a formula could divide by 0.
#include "renderers/scene/frame.h"
#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

using scene::LightType;

bool is_finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

TEST(LightEdgeCases, WhatEmitsNothingIsEmpty) {
    LightScene nothing, dark, left_out;
    nothing.quad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, 0);
    dark.light(make_light(LightType::point, {0, 1, 0}, -up, {1, 1}, 0));
    dark.light(make_light(LightType::rectangle, {0, 1, 0}, -up, {0, 1}, 1));
    dark.light(make_light(LightType::disk, {0, 1, 0}, -up, {0, 0}, 1));
    left_out.quad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, left_out.emitter(glm::vec3(1)));
    left_out.scene().environment.constant = glm::vec3(1);
    for (const auto* sampler : {&nothing.sampler(), &dark.sampler(),
                                &left_out.sampler({.environment = false, .emissive_meshes = false})}) {
        EXPECT_TRUE(sampler->empty());
        EXPECT_FALSE(sampler->has_environment());
        EXPECT_FALSE(sampler->sample({0, 0, 0}, up, 0.5f, glm::vec2(0.5f)));
        EXPECT_EQ(sampler->environment(up), glm::vec3(0));
        EXPECT_EQ(sampler->pdf_of_environment(up, up), 0);
        passes::Hit hit;
        hit.distance = 1;
        EXPECT_EQ(sampler->pdf_of_triangle({0, 0, 0}, up, hit), 0);
    }
    int hits = 0;
    dark.sampler().visit_lights({0, 0, 0}, up, 1e30f, [&](const passes::LightHit&) { ++hits; });
    EXPECT_EQ(hits, 0);
}

TEST(LightEdgeCases, NothingIsEverNotANumber) {
    LightScene world;
    world.light(make_light(LightType::rectangle, {0, 1, 0}, -up, {2, 1}));
    world.light(make_light(LightType::disk, {0, 1, 5}, -up, {2, 1}));
    world.light(make_light(LightType::point, {3, 1, 0}, -up));
    world.light(make_light(LightType::rectangle, {0, 1, 0}, -up, {0, 0}));
    world.triangle({-5, 1, 0}, {-6, 1, 0}, {-5, 1, 1}, world.emitter(glm::vec3(1)));
    world.triangle({-5, 1, 0}, {-6, 1, 0}, {-7, 1, 0}, 1);  // without area
    const auto& sampler = world.sampler();
    Uniform uniform(9);
    // On the lights, in their planes, on a corner, a hair's breadth below.
    for (const glm::vec3 at :
         {glm::vec3(0, 1, 0), glm::vec3(1, 1, 0.5f), glm::vec3(7, 1, 0), glm::vec3(0, 1 - 1e-7f, 0),
          glm::vec3(0.2f, 1 - 1e-20f, 5), glm::vec3(3, 1, 0), glm::vec3(-5, 1, 0), glm::vec3(-5.2f, 1, 0.2f),
          glm::vec3(1, 0.999999f, 0.5f), glm::vec3(1e18f, 0, 0), glm::vec3(0, -1e6f, 0)})
        for (int i = 0; i < 2000; ++i) {
            const float choice = uniform.number();
            const auto s = sampler.sample(at, up, choice, i == 0 ? glm::vec2(0) : uniform.pair());
            if (!s) continue;
            EXPECT_TRUE(is_finite(s->direction_ws) && is_finite(s->radiance)) << at.x;
            EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0) << at.x;
            EXPECT_NEAR(glm::length(s->direction_ws), 1, 1e-4f);
        }
}

TEST(LightEdgeCases, RaysMeetLightsOnlyOnTheSideThatShines) {
    LightScene world;
    world.light(make_light(LightType::rectangle, {0, 2, 0}, -up, {2, 1}, 3));
    world.light(make_light(LightType::disk, {0, 4, 0}, up, {2, 1}, 5));
    const auto& sampler = world.sampler();
    const auto met = [&](glm::vec3 origin, glm::vec3 direction, float far) {
        std::vector<passes::LightHit> hits;
        sampler.visit_lights(origin, direction, far, [&](const auto& hit) { hits.push_back(hit); });
        return hits;
    };
    const auto below = met({0.9f, 0, 0.4f}, up, 1e30f);
    ASSERT_EQ(below.size(), 1u);
    EXPECT_EQ(below[0].light, 0);
    EXPECT_EQ(below[0].distance, 2);
    EXPECT_EQ(below[0].radiance, glm::vec3(3));
    EXPECT_TRUE(met({0.9f, 0, 0.4f}, up, 2).empty()) << "far is left out";
    EXPECT_TRUE(met({1.1f, 0, 0}, up, 1e30f).empty());
    EXPECT_TRUE(met({0.9f, 9, 0.4f}, -up, 1e30f).empty()) << "outside the ellipse";
    ASSERT_EQ(met({0.9f, 9, 0}, -up, 1e30f).size(), 1u);
    EXPECT_EQ(met({0.9f, 9, 0}, -up, 1e30f)[0].light, 1);
    EXPECT_TRUE(met({0, 3, 0}, up, 1e30f).empty()) << "from behind";
}

TEST(LightEdgeCases, FramesAreHeldLikeACamera) {
    const auto check = [](glm::vec3 direction, glm::vec3 width, glm::vec3 height) {
        const auto frame = scene::light_frame(make_light(LightType::rectangle, {0, 0, 0}, direction));
        EXPECT_LT(glm::length(frame.width - width), 1e-6f);
        EXPECT_LT(glm::length(frame.height - height), 1e-6f);
    };
    check({0, 0, -1}, {1, 0, 0}, {0, 1, 0});
    check({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    check({0, -1, 0}, {1, 0, 0}, {0, 0, -1});
    check({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    check({0, -1, -0.5f}, {1, 0, 0}, glm::normalize(glm::vec3(0, 0.5f, -1)));
}

TEST(LightEdgeCases, EverySmallLightIsChosenNowAndThen) {
    // A faint triangle beside a bright point light: one that sends 1 / 1000 of the light is not forgotten.
    LightScene world;
    world.light(make_light(LightType::point, {0, 1, 0}, -up, {1, 1}, 100));
    world.triangle({0, 0, -2}, {0.3f, 0, -2}, {0, 0.3f, -2}, world.emitter(glm::vec3(0.1f)));
    const auto& sampler = world.sampler();
    passes::Hit hit;
    hit.distance = 2;
    hit.u = hit.v = 0.25f;
    EXPECT_GT(sampler.pdf_of_triangle({0, 0, 0}, up, hit), 0);
}

}  // namespace
}  // namespace ir::test
