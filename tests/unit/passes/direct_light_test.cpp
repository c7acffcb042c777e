#include <cmath>
#include <numbers>

#include "renderers/passes/direct/direct_light.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {
namespace {

using scene::Camera;
using scene::Light;
using scene::LightType;

using std::numbers::pi;

/// The metallic-roughness BRDF once more, in double precision and from angles.
struct Brdf {
    glm::dvec3 colour{1};
    double metallic = 0, roughness = 1, ior = 1.5;

    static double lambda(double cosine, double a) {
        const double tan2 = 1 / (cosine * cosine) - 1;
        return 0.5 * (std::sqrt(1 + a * a * tan2) - 1);
    }
    glm::dvec3 operator()(glm::dvec3 n, glm::dvec3 l, glm::dvec3 v) const {
        const auto h = glm::normalize(l + v);
        const double a = roughness * roughness;
        const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h), vh = glm::dot(v, h);
        const double tan2 = 1 / (nh * nh) - 1;
        const double d = 1 / (pi * a * a * std::pow(nh, 4) * std::pow(1 + tan2 / (a * a), 2));
        const double g = 1 / (1 + lambda(nl, a) + lambda(nv, a));
        const double specular = d * g / (4 * nl * nv), grazing = std::pow(1 - vh, 5);
        const double f0 = std::pow((ior - 1) / (ior + 1), 2);
        const double fresnel = f0 + (1 - f0) * grazing;
        if (metallic == 0) return (1 - fresnel) * colour / pi + fresnel * specular;
        return (colour + (1.0 - colour) * grazing) * specular;
    }
};

/// The floor y = 0 seen from above: pixel (x, y) is at world (x, z) = ((x + 1/2) / 32 - 1, …) * 2.
Camera from_above() {
    auto camera = looking({0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    camera.orthographic = true;
    camera.height = 4;
    return camera;
}
constexpr int pixels = 64;
glm::vec3 floor_point(int x, int y) {
    return {(x + 0.5f) / pixels * 4 - 2, 0, (y + 0.5f) / pixels * 4 - 2};
}

class DirectLightTest : public PassTest {
  protected:
    FrameReport render(const Shot& shot, const passes::DirectLightOptions& options = {}) {
        return run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            passes::direct_light(builder, scene, passes::gbuffer(builder, scene), options);
        });
    }
    Image radiance(const scene::Scene& scene, const Camera& camera,
                   const passes::DirectLightOptions& options = {}) {
        render(Shot(scene, camera, pixels, pixels), options);
        return read("direct.radiance");
    }
};

scene::Scene lit_floor(const Light& light) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    auto scene = small.scene();
    scene.materials[0].metallic = 0;
    scene.materials[0].base_colour = {0.75f, 0.5f, 0.25f, 1};
    scene.lights.push_back(light);
    return scene;
}

Light point_light(glm::vec3 position, float intensity) {
    Light light;
    light.position = position;
    light.intensity = intensity;
    return light;
}

TEST_F(DirectLightTest, APointLightGivesFluxCosineOverSquaredDistance) {
    const double flux = 50;
    const glm::vec3 lamp(0.5f, 1.5f, -0.25f);
    for (const double metallic : {0.0, 1.0}) {
        auto scene = lit_floor(point_light(lamp, static_cast<float>(flux / (4 * pi))));
        scene.materials[0].metallic = static_cast<float>(metallic);
        scene.materials[0].roughness = 0.625f;  // like the colours, exact in half precision
        const auto image = radiance(scene, from_above());
        const Brdf brdf{{0.75, 0.5, 0.25}, metallic, 0.625};
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x) {
                const glm::dvec3 offset = lamp - floor_point(x, y);
                const double r2 = glm::dot(offset, offset);
                const auto l = offset / std::sqrt(r2);
                const double irradiance = flux * l.y / (4 * pi * r2);
                const auto expected = brdf({0, 1, 0}, l, {0, 1, 0}) * irradiance;
                const glm::dvec3 found = rgb(image, x, y);
                ASSERT_LT(glm::distance(found, expected), 1e-3 * glm::length(expected)) << x << ' ' << y;
            }
    }
}

TEST_F(DirectLightTest, WithoutAnInterfaceOnlyLambertRemains) {
    auto scene = lit_floor(point_light({0, 2, 0}, 3));
    scene.materials[0].ior = 1;  // no reflection at normal incidence
    const auto image = radiance(scene, from_above());
    const auto p = floor_point(31, 31);
    const double r2 = glm::dot(p, p) + 4, expected = 3 * (2 / std::sqrt(r2)) / r2 / pi;
    EXPECT_LT(glm::distance(glm::dvec3(rgb(image, 31, 31)), expected * glm::dvec3(0.75, 0.5, 0.25)),
              1e-3 * expected);
}

TEST_F(DirectLightTest, DirectionalIrradianceFallsOnEveryPointAlike) {
    Light sun;
    sun.type = LightType::directional;
    sun.direction = glm::normalize(glm::vec3(1, -2, 0.5f));
    sun.intensity = 5;
    auto scene = lit_floor(sun);
    const auto image = radiance(scene, from_above());
    const Brdf brdf{{0.75, 0.5, 0.25}, 0, 1};
    const auto l = -glm::dvec3(sun.direction);
    const auto expected = brdf({0, 1, 0}, l, {0, 1, 0}) * (5 * l.y);
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x)
            ASSERT_LT(glm::distance(glm::dvec3(rgb(image, x, y)), expected), 1e-3 * glm::length(expected));
}

Light spot_light(float inner, float outer) {
    Light spot = point_light({0, 2, 0}, 10);
    spot.type = LightType::spot;
    spot.direction = {0, -1, 0};
    spot.inner_angle = inner;
    spot.outer_angle = outer;
    return spot;
}

TEST_F(DirectLightTest, ASpotWithEqualAnglesHasAHardEdge) {
    const float outer = std::atan(0.5f);  // a disc of radius 1 m
    const auto image = radiance(lit_floor(spot_light(outer, outer)), from_above());
    const auto full = radiance(lit_floor(point_light({0, 2, 0}, 10)), from_above());
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const float radius = glm::length(floor_point(x, y));
            if (std::abs(radius - 1) < 1e-3f) continue;
            EXPECT_EQ(rgb(image, x, y), radius < 1 ? rgb(full, x, y) : glm::vec3(0)) << x << ' ' << y;
        }
}

TEST_F(DirectLightTest, ASpotFadesBetweenItsAngles) {
    const float inner = 0.2f, outer = 0.7f;
    const auto image = radiance(lit_floor(spot_light(inner, outer)), from_above());
    const auto full = radiance(lit_floor(point_light({0, 2, 0}, 10)), from_above());
    for (int x = 0; x < pixels; ++x) {
        const double cosine = 2 / std::sqrt(4 + std::pow(glm::length(floor_point(x, 32)), 2));
        const double part =
            std::clamp((cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
        EXPECT_NEAR(rgb(image, x, 32).x, rgb(full, x, 32).x * part * part, 1e-4);
    }
}

TEST_F(DirectLightTest, AWideSpotTakesACubeAndLightsLikeAPointInside) {
    const auto wide = spot_light(1.5f, 1.5f);
    EXPECT_EQ(passes::shadow_layers(wide), 6);
    const auto image = radiance(lit_floor(wide), from_above());
    const auto full = radiance(lit_floor(point_light({0, 2, 0}, 10)), from_above());
    EXPECT_EQ(image.pixels, full.pixels);
}

TEST_F(DirectLightTest, RangeEndsALight) {
    auto lamp = point_light({0, 1, 0}, 10);
    const auto full = radiance(lit_floor(lamp), from_above());
    lamp.range = 1.5f;
    const auto image = radiance(lit_floor(lamp), from_above());
    for (int x = 0; x < pixels; ++x) {
        const auto p = floor_point(x, 32);
        const double ratio = std::sqrt(glm::dot(p, p) + 1) / 1.5;
        const double window = std::max(0.0, 1 - std::pow(ratio, 4));
        EXPECT_NEAR(rgb(image, x, 32).x, rgb(full, x, 32).x * window, 1e-4 + 1e-4 * rgb(full, x, 32).x);
    }
}

/// The floor with a square of half a side 0.25 m at half the height of a light above it: its shadow is the
/// square of half a side 0.5 m.
scene::Scene shadowed_floor(const Light& light, SmallWorld::Material material = SmallWorld::opaque) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    small.quad({-0.25f, 1, -0.25f}, {0.25f, 1, -0.25f}, {0.25f, 1, 0.25f}, {-0.25f, 1, 0.25f}, material);
    auto scene = small.scene();
    for (auto& each : scene.materials) each.metallic = 0;
    scene.lights.push_back(light);
    return scene;
}

/// From below the blocker and above the floor nothing hides the shadow.
Camera under_the_blocker() {
    auto camera = from_above();
    camera.eye = {0, 0.5f, 0};
    return camera;
}

void expect_square_shadow(const Image& image, float half, float tolerance, float reach = 10) {
    int dark = 0;
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const auto p = floor_point(x, y);
            const float outside = std::max(std::abs(p.x), std::abs(p.z)) - half;
            if (std::abs(outside) < tolerance) continue;
            if (glm::length(p) > reach) continue;
            EXPECT_EQ(image.at(x, y) == 0, outside < 0) << p.x << ' ' << p.z;
            dark += outside < 0;
        }
    EXPECT_GT(dark, 30);
}

TEST_F(DirectLightTest, AShadowsEdgeIsWithinATexelOfTheClosedForm) {
    const passes::DirectLightOptions options{.shadow_resolution = 128};
    const float cube_texel = 2 * 2.0f / 128;  // of a 90-degree map, on the floor
    expect_square_shadow(radiance(shadowed_floor(point_light({0, 2, 0}, 5)), under_the_blocker(), options),
                         0.5f, cube_texel);
    const auto spot = radiance(shadowed_floor(spot_light(0.6f, 0.6f)), under_the_blocker(), options);
    expect_square_shadow(spot, 0.5f, 2 * 2 * std::tan(0.6f) / 128, 1.3f);
    Light sun;
    sun.type = LightType::directional;
    sun.direction = {0, -1, 0};
    expect_square_shadow(radiance(shadowed_floor(sun), under_the_blocker(), options), 0.25f, 8.2f / 128);
}

TEST_F(DirectLightTest, AlphaMasksLetLightThrough) {
    const auto image =
        radiance(shadowed_floor(point_light({0, 2, 0}, 5), SmallWorld::masked), under_the_blocker());
    // the first texel, at -x and -z, is the hole
    EXPECT_GT(image.at(28, 28), 0);
    EXPECT_EQ(image.at(35, 28), 0);
    EXPECT_EQ(image.at(28, 35), 0);
    EXPECT_EQ(image.at(35, 35), 0);
}

TEST_F(DirectLightTest, NoPlaneShadowsItselfAtAnyAngle) {
    for (const float height : {0.02f, 0.1f, 0.5f, 3.0f}) {
        const auto image = radiance(lit_floor(point_light({0.3f, height, 0.1f}, 5)), from_above(),
                                    {.shadow_resolution = 64});
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x) ASSERT_GT(image.at(x, y), 0) << height << ": " << x << ' ' << y;
    }
}

TEST_F(DirectLightTest, TheFilterAveragesTexels) {
    const auto image = radiance(shadowed_floor(point_light({0, 2, 0}, 5)), under_the_blocker(),
                                {.shadow_resolution = 64, .shadow_filter_radius = 1});
    const auto full = radiance(lit_floor(point_light({0, 2, 0}, 5)), under_the_blocker());
    int partial = 0;
    for (int x = 0; x < pixels; ++x) {
        const float part =
            image.at(x, 32) / full.at(x, 32) * 0.75f;  // the floors' base colours are 1 and 0.75
        partial += part > 0.2f && part < 0.7f;
    }
    EXPECT_GE(partial, 2);
}

TEST_F(DirectLightTest, ALightBehindTheSurfaceDoesNotReachIt) {
    const auto image = radiance(lit_floor(point_light({0, -1, 0}, 5)), from_above());
    for (const float value : image.pixels) ASSERT_EQ(value, 0);
}

TEST_F(DirectLightTest, UnlitMaterialsShowTheirColourAndNothingElseIsLitWithoutLights) {
    auto scene = lit_floor({});
    scene.lights.clear();
    auto image = radiance(scene, from_above());
    for (const float value : image.pixels) ASSERT_EQ(value, 0);
    scene.materials[0].unlit = true;
    image = radiance(scene, from_above());
    EXPECT_LT(glm::distance(rgb(image, 9, 9), {0.75f, 0.5f, 0.25f}), 1e-3f);
    EXPECT_EQ(read("shadow.maps").at(0, 0), 1);
}

TEST_F(DirectLightTest, LightsWithExtentAreCountedNotForgotten) {
    auto scene = lit_floor(point_light({0, 2, 0}, 5));
    Light panel;
    panel.type = LightType::rectangle;
    scene.lights.insert(scene.lights.begin(), {panel, panel});
    const auto report =
        render(Shot(scene, from_above(), pixels, pixels), {.extended = {.parameters = {.light_samples = 0}}});
    bool said = false;
    for (const auto& message : report.messages)
        said = said || message.text.find("2 rectangle or disk lights") != std::string::npos;
    EXPECT_TRUE(said);
    EXPECT_GT(read("direct.radiance").at(32, 32), 0) << "the lamp behind them in the list still shines";
}

TEST_F(DirectLightTest, ShadowMapsAreKeptWhileTheWorldStays) {
    const Shot shot(lit_floor(point_light({0, 2, 0}, 5)), from_above(), pixels, pixels);
    auto inputs = shot.inputs();
    inputs.world_fingerprint = "one";
    const auto setup = [](graph::GraphBuilder& builder) {
        const auto scene = passes::upload_scene(builder);
        passes::direct_light(builder, scene, passes::gbuffer(builder, scene));
    };
    const auto skipped = [](const FrameReport& report) {
        for (const auto& pass : report.passes)
            if (pass.name == "shadow maps") return pass.slices == 0;
        return false;
    };
    EXPECT_FALSE(skipped(run(inputs, setup)));
    const auto before = read("direct.radiance");
    EXPECT_TRUE(skipped(run(inputs, setup)));
    EXPECT_EQ(read("direct.radiance").pixels, before.pixels);
    inputs.world_fingerprint = "two";
    EXPECT_FALSE(skipped(run(inputs, setup)));
}

TEST(ShadowViews, MatricesAgreeWithTheirAxes) {
    SmallWorld small;
    small.square({1, 2, 3}, {0, 1, 0}, 4);
    small.square({-1, 5, 2}, {1, 0, 0}, 1);
    auto world = small.world();
    world.lights = {point_light({1, 4, 2}, 1), spot_light(0.3f, 0.5f)};
    world.lights.emplace_back().type = LightType::directional;
    world.lights.back().direction = glm::normalize(glm::vec3(1, -3, 0.4f));
    const auto views = passes::shadow_views(world, 256);
    ASSERT_EQ(views.size(), 8u);
    for (const auto& v : views)
        for (const auto& [x, y, part] : {std::tuple{0.3f, -0.8f, 0.4f}, {-0.9f, 0.1f, 0.99f}}) {
            const float t = v.near + part * (v.far - v.near), s = v.perspective != 0 ? t : 1;
            const auto p = v.origin_ws + t * v.forward_ws + s * (x * v.right_ws + y * v.up_ws);
            const auto clip = v.clip_from_world * glm::vec4(p, 1);
            EXPECT_NEAR(clip.x / clip.w, x, 1e-4f);
            EXPECT_NEAR(clip.y / clip.w, y, 1e-4f);
            EXPECT_GT(clip.z / clip.w, 0);
            EXPECT_LT(clip.z / clip.w, 1);
        }
}

}  // namespace
}  // namespace ir::test
