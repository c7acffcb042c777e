#include "renderers/passes/direct/seen_light.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/environment_light.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

constexpr int size = 32;

/// A camera that looks along -Z from z = 4 with a lamp at z = 0 and, on its left half, a plate before it.
class SeenLightTest : public PassTest {
  protected:
    static scene::Scene lamp_and_plate(bool faces_the_camera) {
        SmallWorld small;
        small.quad({-1, -2, 1}, {0, -2, 1}, {0, 2, 1}, {-1, 2, 1});
        auto scene = small.scene();
        scene::Light lamp;
        lamp.type = scene::LightType::rectangle;
        lamp.direction = {0, 0, faces_the_camera ? 1 : -1};
        lamp.colour = {1, 0.5f, 0.25f};
        lamp.intensity = 8;
        lamp.size = {1, 1};
        scene.lights.push_back(lamp);
        return scene;
    }
    static scene::Camera camera() {
        auto camera = looking({0, 0, 4}, {0, 0, 0});
        camera.orthographic = true;
        camera.height = 2;
        return camera;
    }
    passes::SeenLight see(const Shot& shot, const Transport& transport) {
        passes::SeenLight seen;
        run(shot, [&](graph::GraphBuilder& builder) {
            seen = passes::seen_light(builder, passes::gbuffer(builder, passes::upload_scene(builder)),
                                      transport);
        });
        return seen;
    }
    const Transport full{.paths = Transport::Paths::full};
};

TEST_F(SeenLightTest, ALampIsSeenFromItsFrontWhereNothingIsBefore) {
    see(Shot(lamp_and_plate(true), camera(), size, size), full);
    const auto image = read("direct.seen");
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / size * 2 - 1;
            const float v = (static_cast<float>(y) + 0.5f) / size * 2 - 1;
            const bool shines = u > 0 && u < 0.5f && std::abs(v) < 0.5f;
            ASSERT_EQ(rgb(image, x, y), shines ? glm::vec3(8, 4, 2) : glm::vec3(0)) << x << ' ' << y;
        }
    see(Shot(lamp_and_plate(false), camera(), size, size), full);
    for (int i = 0; i < size; ++i) EXPECT_EQ(rgb(read("direct.seen"), i, size / 2), glm::vec3(0));
}

TEST_F(SeenLightTest, AMapIsSeenBehindEverything) {
    auto scene = lamp_and_plate(false);
    auto map = std::make_shared<Image>(8, 4, 3);
    for (std::size_t i = 0; i < map->pixels.size(); ++i) map->pixels[i] = static_cast<float>(i % 7);
    scene.environment.map = map;
    auto perspective = looking({0, 0, 4}, {0, 0, 0});
    const Shot shot(scene, perspective, size, size);
    const auto seen = see(shot, full);
    EXPECT_EQ(seen.background, glm::vec3(0));
    const passes::EnvironmentLight light(scene.environment);
    const auto image = read("direct.seen"), position = read("gbuffer.position");
    const auto rays = passes::pixel_rays(shot.view);
    int open = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            glm::vec3 expected(0);
            if (position.at(x, y, 3) == 0) {
                const auto direction = rays.direction + (static_cast<float>(x) + 0.5f) * rays.direction_dx +
                                       (static_cast<float>(y) + 0.5f) * rays.direction_dy;
                expected = light.radiance(glm::normalize(direction));
                ++open;
            }
            ASSERT_LT(glm::distance(rgb(image, x, y), expected), 1e-4f) << x << ' ' << y;
        }
    EXPECT_GT(open, 100);
    EXPECT_LT(open, size * size - 100);
}

TEST_F(SeenLightTest, AConstantNeedsNoImageAndOnlyFullPathsSeeAnything) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    scene.environment.constant = {1, 2, 3};
    const Shot shot(scene, camera(), size, size);
    const auto seen = see(shot, full);
    EXPECT_EQ(seen.background, glm::vec3(1, 2, 3));
    EXPECT_FALSE(seen.image);
    auto without = full;
    without.environment_light = false;
    EXPECT_EQ(see(shot, without).background, glm::vec3(0));
    const Shot lamp(lamp_and_plate(true), camera(), size, size);
    EXPECT_FALSE(see(lamp, {.paths = Transport::Paths::direct}).image);
    EXPECT_TRUE(see(lamp, full).image);
}

}  // namespace
}  // namespace ir::test
