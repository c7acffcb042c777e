// Irradiance by sampling against closed forms; z-tests with α = 1e-4.
#include "renderers/scene/frame.h"
#include "tests/unit/passes/light_fixture.h"

namespace ir::test {
namespace {

using passes::LightSampler;
using scene::LightType;

/// E / L of a polygon wholly above the facet's plane: ½ Σ of the edges' angles times the cosine between the
/// facet's normal and the normal of the plane through facet and edge.  [Lambert 1760; Baum89 eq. 7]
double polygon_factor(const std::vector<glm::vec3>& corners, glm::vec3 position, glm::vec3 normal) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto a = glm::normalize(glm::dvec3(corners[i] - position));
        const auto b = glm::normalize(glm::dvec3(corners[(i + 1) % corners.size()] - position));
        const auto across = glm::cross(a, b);
        sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(across), glm::dvec3(normal));
    }
    return 0.5 * std::abs(sum);
}

TEST(LightIrradiance, PointLightOverAPlane) {
    const double flux = 40;
    LightScene world;
    world.light(make_light(LightType::point, {0, 2, 0}, -up, {1, 1}, static_cast<float>(flux / (4 * pi))));
    const auto& sampler = world.sampler();
    for (const float x : {0.0f, 1.0f, 5.0f}) {
        const double squared = x * x + 4, cosine = 2 / std::sqrt(squared);
        const auto e = irradiance(sampler, {x, 0, 0}, up, 4);
        EXPECT_NEAR(e.mean, flux * cosine / (4 * pi * squared), 1e-5 * e.mean);
        EXPECT_LT(e.error, 1e-6);
    }
}

TEST(LightIrradiance, SpotEndsAtItsConeAndLightAtItsRange) {
    auto spot = make_light(LightType::spot, {0, 2, 0}, -up, {1, 1}, 8);
    spot.inner_angle = 0.2f, spot.outer_angle = 0.5f;
    auto point = make_light(LightType::point, {10, 2, 0}, -up, {1, 1}, 8);
    point.range = 3;
    LightScene spots, points;
    spots.light(spot);
    points.light(point);
    const auto& by_spot = spots.sampler();
    const auto& by_point = points.sampler();
    EXPECT_NEAR(irradiance(by_spot, {0, 0, 0}, up, 1).mean, 2, 1e-5);
    const double angle = 0.3, fraction = (std::cos(angle) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5));
    EXPECT_NEAR(irradiance(by_spot, {2 * std::tan(angle), 0, 0}, up, 1).mean,
                2 * fraction * fraction * std::pow(std::cos(angle), 3), 1e-4);
    EXPECT_EQ(irradiance(by_spot, {2 * std::tan(0.51), 0, 0}, up, 1).mean, 0);
    EXPECT_NEAR(irradiance(by_point, {10, 0, 0}, up, 1).mean, 2 * (1 - std::pow(2.0 / 3, 4)), 1e-5);
    EXPECT_EQ(irradiance(by_point, {10, -1.1f, 0}, up, 1).mean, 0);
}

TEST(LightIrradiance, DirectionalLight) {
    LightScene world;
    world.light(make_light(LightType::directional, {0, 0, 0}, {0, -3, -4}, {1, 1}, 5));
    const auto& sampler = world.sampler();
    EXPECT_NEAR(irradiance(sampler, {1, 2, 3}, up, 4).mean, 3, 1e-5);
    const auto s = sampler.sample({1, 2, 3}, up, 0.5f, glm::vec2(0.5f));
    ASSERT_TRUE(s);
    EXPECT_TRUE(s->is_delta);
    EXPECT_TRUE(std::isinf(s->distance));
    EXPECT_EQ(s->pdf, 1);
}

TEST(LightIrradiance, ParallelDisk) {
    // E = π L R² / (R² + h²) on the axis; n = 20,000.
    LightScene world;
    world.light(make_light(LightType::disk, {0, 2, 0}, -up, {3, 3}, 7));
    const auto& sampler = world.sampler();
    const double expected = 7 * pi * 2.25 / (2.25 + 4);
    const auto e = irradiance(sampler, {0, 0, 0}, up, 20000);
    expect_mean(e, expected);
    // Mutant: the size read as radii.
    EXPECT_GT(std::abs(e.mean - 7 * pi * 9 / (9 + 4)), 3.891 * e.error);
}

TEST(LightIrradiance, ParallelRectangle) {
    // Four times the rectangle with a corner above the facet. n = 20,000 at each place.
    const double a = 1.5 / 2, b = 0.5 / 2;
    const auto part = [](double x, double y) {
        return x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x));
    };
    LightScene world;
    world.light(make_light(LightType::rectangle, {0, 2, 0}, -up, {3, 1}, 7));
    const auto& sampler = world.sampler();
    const double expected = 7 * 4 * 0.5 * (part(a, b) + part(b, a));
    const std::vector<glm::vec3> corners{{-1.5, 2, -.5}, {1.5, 2, -.5}, {1.5, 2, .5}, {-1.5, 2, .5}};
    EXPECT_NEAR(7 * polygon_factor(corners, glm::vec3(0), up), expected, 1e-5) << "of the test itself";
    expect_mean(irradiance(sampler, {0, 0, 0}, up, 20000), expected, "below the centre");
    for (const glm::vec3 at : {glm::vec3(1.4f, 1.9f, 0.4f), glm::vec3(-3, 0, 2), glm::vec3(0, -20, 9)})
        expect_mean(irradiance(sampler, at, up, 20000), 7 * polygon_factor(corners, at, up), "aside");
}

TEST(LightIrradiance, PerpendicularRectangle) {
    // n = 20,000 at each place. A rectangle that stands on the facet's plane, 2 wide, 1 high.
    LightScene world;
    world.light(make_light(LightType::rectangle, {0, 0.5f, -1}, {0, 0, 1}, {2, 1}, 3));
    const auto& sampler = world.sampler();
    const std::vector<glm::vec3> corners{{-1, 0, -1}, {1, 0, -1}, {1, 1, -1}, {-1, 1, -1}};
    for (const glm::vec3 at : {glm::vec3(0), glm::vec3(0.5f, 0, -0.9f), glm::vec3(3, 0, 1)})
        expect_mean(irradiance(sampler, at, up, 20000), 3 * polygon_factor(corners, at, up));
}

TEST(LightIrradiance, EmissiveQuadOfTwoTrianglesShinesOnBothSides) {
    LightScene world;
    world.quad({-1, 2, -1}, {1, 2, -1}, {1, 2.5f, 1}, {-1, 2.5f, 1}, world.emitter(glm::vec3(4)));
    const auto& sampler = world.sampler();
    const std::vector<glm::vec3> corners{{-1, 2, -1}, {1, 2, -1}, {1, 2.5f, 1}, {-1, 2.5f, 1}};
    for (const glm::vec3 at : {glm::vec3(0), glm::vec3(0.5f, 1.5f, 0), glm::vec3(4, 0, 1)})
        expect_mean(irradiance(sampler, at, up, 40000), 4 * polygon_factor(corners, at, up), "below");
    const glm::vec3 above(0.2f, 4, 0);
    expect_mean(irradiance(sampler, above, -up, 40000), 4 * polygon_factor(corners, above, -up), "above");
}

TEST(LightIrradiance, AllOfThemAddUp) {
    // n = 100,000; a share of the lights is chosen each time.
    LightScene world;
    world.light(make_light(LightType::rectangle, {0, 2, 0}, -up, {3, 1}, 2));
    world.light(make_light(LightType::point, {1, 1, 0}, -up, {1, 1}, 0.3f));
    world.light(make_light(LightType::directional, {0, 0, 0}, {0, -1, 0}, {1, 1}, 0.5f));
    world.quad({-3, 1, -1}, {-2, 1, -1}, {-2, 1, 1}, {-3, 1, 1}, world.emitter(glm::vec3(3)));
    world.scene().environment.constant = glm::vec3(0.25f);
    const auto& sampler = world.sampler();
    const double expected =
        2 * polygon_factor({{-1.5, 2, -.5}, {1.5, 2, -.5}, {1.5, 2, .5}, {-1.5, 2, .5}}, glm::vec3(0), up) +
        0.3 / 2 * std::sqrt(0.5) + 0.5 +
        3 * polygon_factor({{-3, 1, -1}, {-2, 1, -1}, {-2, 1, 1}, {-3, 1, 1}}, glm::vec3(0), up) + 0.25 * pi;
    const auto e = irradiance(sampler, {0, 0, 0}, up, 100000);
    expect_mean(e, expected);
    // Mutant: the probability of the choice forgotten for the sun alone.
    EXPECT_GT(std::abs(e.mean - (expected - 0.4)), 3.891 * e.error);
}

TEST(LightIrradiance, HolesOfAMaskSendNothing) {
    // A square whose lower left quarter is a hole; n = 50,000.
    LightScene world;
    auto& scene = world.scene();
    const int glow = world.emitter(glm::vec3(4));
    scene.materials.back().alpha_mode = scene::AlphaMode::mask;
    scene.materials.back().base_colour_texture.texture = 0;
    auto& texture = scene.textures.emplace_back();
    texture.width = texture.height = 2;
    texture.rgba.assign(16, 255);
    texture.rgba[3] = 0;
    world.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, glow);
    const auto factor = [](float x0, float x1, float z0, float z1) {
        return polygon_factor({{x0, 2, z0}, {x1, 2, z0}, {x1, 2, z1}, {x0, 2, z1}}, glm::vec3(0), up);
    };
    const double whole = 4 * factor(-1, 1, -1, 1), hole = 4 * factor(-1, 0, -1, 0);
    const auto e = irradiance(world.sampler(), {0, 0, 0}, up, 50000);
    expect_mean(e, whole - hole);
    EXPECT_GT(std::abs(e.mean - whole), 3.891 * e.error) << "the mask ignored";
}

TEST(LightIrradiance, TexturesOfEmissionCount) {
    // Half black, half white (nearest): only the right half sends light; n = 50,000.
    LightScene world;
    const int glow = world.emitter(glm::vec3(4));
    auto& scene = world.scene();
    scene.materials.back().emission_texture.texture = 0;
    auto& texture = scene.textures.emplace_back();
    texture.width = 2, texture.height = 1;
    texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};
    texture.sampler.mag = texture.sampler.min = scene::Filter::nearest;
    world.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, glow);
    const glm::vec3 at(0.3f, 1, 0);
    const double expected = 4 * polygon_factor({{0, 2, -1}, {1, 2, -1}, {1, 2, 1}, {0, 2, 1}}, at, up);
    expect_mean(irradiance(world.sampler(), at, up, 50000), expected);
}

}  // namespace
}  // namespace ir::test
