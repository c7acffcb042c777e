#include <cmath>

#include "renderers/core/constants.h"
#include "tests/unit/methods/surfels_fixture.h"

namespace ir::test {
namespace {

using Paths = Transport::Paths;
using Materials = Transport::Materials;

scene::Light sun(glm::vec3 direction) {
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = glm::normalize(direction);
    light.intensity = 2;
    light.colour = {1, 0.5f, 0.25f};
    return light;
}

/// A floor of 2 m, lit from above.
scene::Scene floor_scene(SmallWorld::Material material = SmallWorld::opaque) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 1, material);
    auto scene = small.scene();
    for (auto& m : scene.materials) {
        m.base_colour = {0.8f, 0.6f, 0.4f, 1};
        m.metallic = 0;
    }
    scene.lights = {sun({1, -1, 0})};
    return scene;
}

class SurfelLightTest : public SurfelTest {
  protected:
    static SurfelRun lit(Paths paths = Paths::indirect, Materials materials = Materials::lambert) {
        auto run = whole();
        run.parameters.transport.paths = paths;
        run.parameters.transport.materials = materials;
        return run;
    }
    /// By the device, to which the host must agree.
    std::vector<dss::ShownSurfel> made(scene::Scene scene, SurfelRun run) {
        const Shot shot(std::move(scene), camera({0, 3, 0.1f}, {0, 0, 0}), 32, 32);
        run.on = Processor::host;
        make(shot, run);
        const auto host = shown();
        run.on = Processor::gl;
        make(shot, run);
        auto result = shown();
        EXPECT_GT(result.size(), 20u);
        EXPECT_EQ(host.size(), result.size());
        for (std::size_t i = 0; i < std::min(host.size(), result.size()); ++i) {
            expect_near(host[i].radiance_front, result[i].radiance_front, 1e-3f);
            expect_near(host[i].radiance_back, result[i].radiance_back, 1e-3f);
        }
        return result;
    }
    static void expect_near(glm::vec3 found, glm::vec3 expected, float relative) {
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], relative * expected[i] + 1e-7f);
    }
    static glm::vec3 light_on_floor() { return glm::vec3(2, 1, 0.5f) * std::sqrt(0.5f); }
};

TEST_F(SurfelLightTest, AFloorSendsItsIrradianceOverPiOnTheLitSideAlone) {
    const auto expected = glm::vec3(0.8f, 0.6f, 0.4f) / ir::pi * light_on_floor();
    for (const auto& surfel : made(floor_scene(), lit())) {
        EXPECT_GT(surfel.normal_ws.y, 0.999f);
        expect_near(surfel.radiance_front, expected, 1e-3f);
        EXPECT_EQ(surfel.radiance_back, glm::vec3(0));
    }
    auto below = floor_scene();
    below.lights = {sun({1, 1, 0})};
    for (const auto& surfel : made(below, lit())) {
        expect_near(surfel.radiance_back, expected, 1e-3f);
        EXPECT_EQ(surfel.radiance_front, glm::vec3(0));
    }
}

TEST_F(SurfelLightTest, InterfacesMetalAndGlassTakeTheirPart) {
    const auto expected = glm::vec3(0.8f, 0.6f, 0.4f) / ir::pi * light_on_floor();
    for (const auto& surfel : made(floor_scene(), lit(Paths::indirect, Materials::gltf)))
        expect_near(surfel.radiance_front, 0.96f * expected, 2e-3f);
    auto half_metal = floor_scene();
    for (auto& m : half_metal.materials) m.metallic = 0.5f;
    for (const auto& surfel : made(half_metal, lit(Paths::indirect, Materials::metalness_blend)))
        expect_near(surfel.radiance_front, 0.5f * expected, 1e-3f);
    auto glass = floor_scene();
    for (auto& m : glass.materials) m.transmission = 0.75f;
    for (const auto& surfel : made(glass, lit(Paths::indirect, Materials::metalness_blend)))
        expect_near(surfel.radiance_front, 0.25f * expected, 1e-3f);
    auto unlit = floor_scene();
    for (auto& m : unlit.materials) m.unlit = true;
    for (const auto& surfel : made(unlit, lit())) EXPECT_EQ(surfel.radiance_front, glm::vec3(0));
}

/// It is direct light where it arrives, which is sampled.
TEST_F(SurfelLightTest, EmissionIsNotSent) {
    auto scene = floor_scene();
    scene.lights.clear();
    for (auto& m : scene.materials) m.emission = {3, 2, 1};
    for (const auto paths : {Paths::full, Paths::indirect, Paths::ao})
        for (const auto& surfel : made(scene, lit(paths))) {
            EXPECT_EQ(surfel.radiance_front, glm::vec3(0));
            EXPECT_EQ(surfel.radiance_back, glm::vec3(0));
        }
}

TEST_F(SurfelLightTest, AmbientOcclusionNeedsNoLight) {
    for (const auto& surfel : made(floor_scene(), lit(Paths::ao)))
        EXPECT_EQ(surfel.radiance_front, glm::vec3(0));
}

TEST_F(SurfelLightTest, ShadowsAreDark) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 1);
    small.quad({-1, 1, -1}, {-1, 1, 1}, {0, 1, 1}, {0, 1, -1});
    auto scene = small.scene();
    scene.lights = {sun({0, -1, 0})};
    int dark = 0, bright = 0;
    for (const auto& surfel : made(scene, lit())) {
        if (surfel.centre_ws.y > 0.5f || std::abs(surfel.centre_ws.x) < 0.05f) continue;
        const bool is_lit = surfel.radiance_front.x > 0;
        EXPECT_EQ(is_lit, surfel.centre_ws.x > 0) << surfel.centre_ws.x;
        ++(is_lit ? bright : dark);
    }
    EXPECT_GT(dark, 10);
    EXPECT_GT(bright, 10);
}

TEST_F(SurfelLightTest, ColoursComeFromTextures) {
    auto scene = floor_scene();
    scene::Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.rgba = {255, 0, 0, 255, 0, 255, 0, 255};
    texture.sampler.min = texture.sampler.mag = scene::Filter::nearest;
    scene.textures.push_back(texture);
    auto& material = scene.materials[SmallWorld::opaque];
    material.base_colour = glm::vec4(1);
    material.base_colour_texture.texture = static_cast<int>(scene.textures.size()) - 1;
    const Shot shot(scene, camera({0, 3, 0.1f}, {0, 0, 0}), 32, 32);
    make(shot, lit());
    int red = 0, green = 0;
    const auto records = surfels();
    const auto seen = shown();
    ASSERT_EQ(seen.size(), records.size());
    for (std::size_t k = 0; k < records.size(); ++k) {
        const auto& surfel = records[k];
        const double u = (surfel.barycentrics & 0xffff) / 65535.0, v = (surfel.barycentrics >> 16) / 65535.0;
        const auto uv = [&](std::size_t i) {
            return glm::dvec2(shot.world.uv0[shot.world.indices[3 * surfel.triangle + i]]);
        };
        const double s = ((1 - u - v) * uv(0) + u * uv(1) + v * uv(2)).x;
        if (std::abs(s - 0.5) < 1e-3) continue;
        EXPECT_EQ(seen[k].radiance_front.x > 0, s < 0.5);
        EXPECT_EQ(seen[k].radiance_front.y > 0, s > 0.5);
        ++(s < 0.5 ? red : green);
    }
    EXPECT_GT(red, 20);
    EXPECT_GT(green, 20);
}

TEST_F(SurfelLightTest, HolesOfAlphaMasksHaveNoSurfels) {
    auto run = lit(Paths::ao);
    run.parameters.thinning = false;
    run.parameters.surfel_radius = 0.5f;
    // uv 0 to 1/2: x and z from the quad's first corner
    const Shot shot(floor_scene(SmallWorld::masked), camera({0, 3, 0.1f}, {0, 0, 0}), 32, 32);
    make(shot, run);
    const auto all = surfels();
    const double whole_area = area(fine());
    const auto corner = shot.world.positions[shot.world.indices[0]];
    for (const auto& surfel : all) {
        const auto offset = glm::abs(surfel.centre_ws - corner);
        EXPECT_FALSE(offset.x < 0.999f && offset.z < 0.999f);
    }
    // n = surfels of equal area, each in the hole with probability 1/4; 3.9: alpha = 1e-4 on both sides
    const double n = static_cast<double>(fine().size());
    EXPECT_NEAR(area(all) / whole_area, 0.75, 3.9 * std::sqrt(0.25 * 0.75 / n));
}

}  // namespace
}  // namespace ir::test
