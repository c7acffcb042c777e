#include <algorithm>
#include <cmath>

#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/raytracing/bvh.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

/// Pixels that one light could reach, and those of them where shadow map and ray disagree.
struct Tally {
    int facing = 0, lit = 0, false_shadow = 0, false_light = 0;
};

class ShadowRaysTest : public PassTest {
  protected:
    Tally compare(Shot shot, const scene::Light& light, int resolution) {
        shot.world.lights = {light};
        shot.scene.environment = {};
        for (auto& material : shot.scene.materials) {
            material.unlit = false;
            material.emission = {};  // its light reaches into the shadows of others
            material.base_colour = {1, 1, 1, material.base_colour.a};
        }
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            passes::direct_light(builder, scene, passes::gbuffer(builder, scene),
                                 {.shadow_resolution = resolution});
        });
        const passes::Bvh bvh(shot.scene, shot.world);
        const float epsilon = 1e-4f * shot.world.bounds.radius();
        const auto radiance = read("direct.radiance"), position = read("gbuffer.position");
        const auto normal = read("gbuffer.normal"), geometric = read("gbuffer.geometric_normal");
        Tally tally;
        for (int y = 0; y < radiance.height; ++y)
            for (int x = 0; x < radiance.width; ++x) {
                if (position.at(x, y, 3) == 0) continue;
                const auto p = rgb(position, x, y), n = rgb(geometric, x, y);
                const bool sun = light.type == scene::LightType::directional;
                const auto offset = sun ? -1000.0f * light.direction : light.position - p;
                const auto l = glm::normalize(offset);
                if (glm::dot(n, l) < 0.02f || glm::dot(rgb(normal, x, y), l) < 0.02f) continue;
                ++tally.facing;
                const bool open = !bvh.occluded(p + epsilon * n, l, 0, glm::length(offset));
                const bool lit =
                    std::max({radiance.at(x, y, 0), radiance.at(x, y, 1), radiance.at(x, y, 2)}) > 0;
                tally.lit += open;
                tally.false_shadow += open && !lit;
                tally.false_light += !open && lit;
            }
        return tally;
    }
    /// Texels are coarser than pixels, so borders of shadows differ; wide areas must not.
    static void expect_agreement(const std::string& name, const Tally& tally, double tolerance) {
        ASSERT_GT(tally.facing, 1000);
        ASSERT_GT(tally.lit, 200);
        EXPECT_LT(tally.lit, tally.facing) << "nothing is in shadow";
        EXPECT_LT(tally.false_shadow, tolerance * tally.facing);
        EXPECT_LT(tally.false_light, tolerance * tally.facing);
        RecordProperty(name + "_facing", tally.facing);
        RecordProperty(name + "_false_shadow", tally.false_shadow);
        RecordProperty(name + "_false_light", tally.false_light);
    }
};

scene::Light lamp(glm::vec3 position) {
    scene::Light light;
    light.position = position;
    light.intensity = 100;
    return light;
}

scene::Light sun(glm::vec3 direction) {
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = glm::normalize(direction);
    return light;
}

TEST_F(ShadowRaysTest, CornellAgreesWithRays) {
    expect_agreement(
        "lamp", compare({"builtin:cornell", "front", 128, 128}, lamp({0.05f, 0.5f, -0.25f}), 1024), 0.005);
}

TEST_F(ShadowRaysTest, AtriumAgreesWithRays) {
    const Shot shot("builtin:atrium", "nave", 160, 120);
    expect_agreement("sun", compare(shot, sun({0.3f, -1, 0.4f}), 1024), 0.02);
    expect_agreement("lamp", compare(shot, lamp({0, 4, 0}), 1024), 0.02);
}

TEST_F(ShadowRaysTest, SponzaAgreesWithRays) {
    const auto file = scene_file("sponza.glb");
    if (file.empty()) GTEST_SKIP() << "set INTERREFLECT_SCENES to the folder that has sponza.glb";
    const auto scene = scene::load_scene(file);
    scene::Camera camera;
    camera.eye = {-8, 2, 0};
    camera.target = {8, 3, 1};
    const Shot shot(scene, camera, 160, 120);
    expect_agreement("sun", compare(shot, sun({0.2f, -1, 0.3f}), 1024), 0.025);
    expect_agreement("lamp", compare(shot, lamp({0, 4, 0}), 1024), 0.025);
}

}  // namespace
}  // namespace ir::test
