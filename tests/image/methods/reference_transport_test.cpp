// Light between surfaces against closed forms. Each mean is that of 64 independent seeds with 64 samples; t
// has 63 degrees of freedom. The comparisons of this file are 20: |t| < 5.2 holds for each with α = 1e-4 / 20
// two-sided (2.3e-6 at 5.2).
#include <gtest/gtest.h>

#include "renderers/methods/reference/passes.h"
#include "tests/image/methods/reference_lab.h"

namespace ir::methods::reference {
namespace {

using Paths = Transport::Paths;
constexpr double critical_t = 5.2, pi = glm::pi<double>();
constexpr int seeds = 64;
constexpr std::uint64_t samples = 64;

/// A diffuse surface of this albedo and material 0 at a point: seen from above it.
PathStart at_surface(glm::vec3 position, glm::vec3 normal, float albedo, passes::Surface& surface) {
    surface = {};
    surface.position_ws = position;
    surface.geometric_normal_ws = surface.shading_normal_ws = normal;
    surface.base_colour = glm::vec3(albedo);
    PathStart start = ray(position + normal, -normal);
    start.is_known = true;
    start.distance = 1;
    start.surface = &surface;
    return start;
}

/// Uniform over the unit square 0 ≤ x, z ≤ 1, y = 0, seen from above.
const Starter on_unit_square = [](const PathSampler& sampler, passes::Surface& surface) {
    const auto u = sampler.pair(in_pixel);
    return at_surface({u.x, 0, u.y}, {0, 1, 0}, 1, surface);
};

/// From a unit square to one of equal size above it at distance 1.  [Howell10, C-11]
double parallel_form_factor() {
    const double r = std::sqrt(2.0);
    return 2 / pi * (std::log(2 / std::sqrt(3.0)) + 2 * r * std::atan(1 / r) - 2 * std::atan(1.0));
}
/// From a unit square to one that shares an edge at a right angle.  [Howell10, C-14]
double perpendicular_form_factor() {
    const double r = std::sqrt(2.0);
    return (2 * std::atan(1.0) - r * std::atan(1 / r) + 0.25 * std::log(3.0 / 4)) / pi;
}

TEST(ReferenceFormFactors, ClosedFormsAreThoseOfTheTables) {
    EXPECT_NEAR(parallel_form_factor(), 0.199825, 1e-6);
    EXPECT_NEAR(perpendicular_form_factor(), 0.200044, 1e-6);
}

/// Emitters of radiance 1 and no reflection: B = ρ F L on the unit square.
Lab plate(glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Lab lab;
    lab.material(glm::vec3(1));
    lab.quad(lab.material(glm::vec3(0), glm::vec3(1)), corner, u, v);
    lab.build();
    return lab;
}

TEST(ReferenceFormFactors, ParallelPlates) {
    const auto lab = plate({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    const auto found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples);
    EXPECT_LT(std::abs(t_of(found, parallel_form_factor())), critical_t) << spread(found).mean;
}

TEST(ReferenceFormFactors, PerpendicularPlates) {
    const auto lab = plate({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples);
    EXPECT_LT(std::abs(t_of(found, perpendicular_form_factor())), critical_t) << spread(found).mean;
}

TEST(ReferenceFormFactors, RejectLightThatIsCountedTwice) {
    const auto lab = plate({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
    Estimator mutant;
    mutant.combine = without_weights;
    const auto found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples, mutant);
    EXPECT_GT(std::abs(t_of(found, parallel_form_factor())), critical_t);
}

TEST(ReferenceFormFactors, RejectAWrongDensity) {
    // Mutant: the balance of the two techniques swapped, as if each had the density of the other.
    const auto lab = plate({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    Estimator mutant;
    mutant.combine = [](float pdf, float other) { return passes::power_heuristic(other, pdf); };
    auto found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples, mutant);
    // Swapped weights still add up to 1 where both techniques see the same: only the noise grows.
    EXPECT_GT(spread(found).variance,
              spread(estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples)).variance);
    mutant.combine = [](float pdf, float other) { return passes::power_heuristic(pdf, 2 * other); };
    found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples, mutant);
    EXPECT_GT(std::abs(t_of(found, perpendicular_form_factor())), critical_t);
}

TEST(ReferenceFormFactors, RectangleLightsAreAsGoodAsEmissiveMeshes) {
    Lab lab;
    lab.material(glm::vec3(1));
    scene::Light light;
    light.type = scene::LightType::rectangle;
    light.position = {0.5f, 1, 0.5f};
    light.direction = {0, -1, 0};
    lab.light(light);
    lab.quad(0, {5, 5, 5}, {1, 0, 0}, {0, 1, 0});  // elsewhere: worlds have something in them
    lab.build();
    const auto found = estimates(lab, transport(Paths::direct), on_unit_square, seeds, samples);
    EXPECT_LT(std::abs(t_of(found, parallel_form_factor())), critical_t) << spread(found).mean;
}

/// A point light of flux Φ above the origin, on a plane y = 0.
Lab point_light(float height, float flux) {
    Lab lab;
    lab.quad(lab.material(glm::vec3(0.7f)), {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    scene::Light light;
    light.position = {0, height, 0};
    light.intensity = flux / (4 * glm::pi<float>());
    lab.light(light);
    lab.build();
    return lab;
}

/// E = Φ cosθ / (4π r²), and ρ E / π of it is seen.
double lambert_of_point_light(double flux, double height, double x, double cosine_power = 1) {
    const double r2 = height * height + x * x;
    return 0.7 / pi * flux * std::pow(height / std::sqrt(r2), cosine_power) / (4 * pi * r2);
}

TEST(ReferencePointLight, FollowsTheInverseSquare) {
    const auto lab = point_light(2, 100);
    for (const float x : {0.0f, 1.0f, 7.0f}) {
        const auto found = estimates(
            lab, transport(Paths::direct),
            [=](auto&, auto&) {
                return ray({x, 1, 0.5f}, {0, -2, -1});
            },
            seeds, samples);
        // Nothing is random here. Rays start some micrometres above the surface, closer to the light.
        const double expected = lambert_of_point_light(100, 2, x);
        EXPECT_NEAR(spread(found).mean, expected, 5e-5 * expected);
        EXPECT_NEAR(spread(found).variance, 0, 1e-10 * expected * expected);
        // Mutant: without the cosine, or with its square.
        if (x == 0) continue;
        EXPECT_GT(std::abs(t_of(found, lambert_of_point_light(100, 2, x, 0))), critical_t);
        EXPECT_GT(std::abs(t_of(found, lambert_of_point_light(100, 2, x, 2))), critical_t);
    }
}

TEST(ReferencePointLight, IsBlockedByGlass) {
    Lab lab;
    lab.quad(lab.material(glm::vec3(0.7f)), {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    scene::Material glass;
    glass.transmission = 1;
    lab.quad(lab.material(glass), {-50, 1.5f, 50}, {100, 0, 0}, {0, 0, -100});
    scene::Light light;
    light.position = {0, 2, 0};
    lab.light(light);
    lab.build();
    const auto found = estimates(
        lab, transport(Paths::full, 1, 4, Transport::Materials::gltf),
        [](auto&, auto&) {
            return ray({0.3f, 1, 0}, {0, -1, 0});
        },
        4, 16);
    EXPECT_EQ(spread(found).mean, 0);
}

/// A room open at the front, z = 1, with a lamp in its middle that shines to both sides.
class OpenRoom {
  public:
    struct Wall {
        glm::vec3 corner, u, v;
        float albedo;
        double area() const { return glm::length(glm::cross(u, v)); }
        glm::vec3 normal() const { return glm::normalize(glm::cross(u, v)); }
    };
    OpenRoom() {
        walls = {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0.7f},
                 {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0.8f},
                 {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.75f},
                 {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.3f},
                 {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.4f},
                 {{0.3f, 0.6f, 0.4f}, {0, 0, 0.3f}, {0.3f, 0, 0}, 0.5f},
                 {{0.3f, 0.6f, 0.4f}, {0.3f, 0, 0}, {0, 0, 0.3f}, 0.5f}};
        for (std::size_t i = 0; i < walls.size(); ++i) {
            const auto& w = walls[i];
            const int material = lab.material(glm::vec3(w.albedo), glm::vec3(i < lamp ? 0.0f : 10.0f));
            if (i <= lamp) lab.quad(material, w.corner, w.u, w.v);  // the lamp's other side is the same quad
        }
        lab.build();
    }
    double emitted() const { return 2 * pi * 10 * walls[lamp].area(); }

    static constexpr std::size_t lamp = 5;
    Lab lab;
    std::vector<Wall> walls;
};

/// Paths of each wall and of the opening.
constexpr std::uint64_t points = 512;

/// Of one seed: what walls absorb and what leaves through the opening, over what is emitted.
double balance(const OpenRoom& room, const PathWorld& world, const Estimator& estimator, std::uint64_t seed) {
    Wavefront reflected(world, PathRules(transport(Paths::full, 1, 64)), estimator);
    double watts = 0;
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
        const auto& w = room.walls[i];
        const auto pixel = trace_pixel(
            reflected,
            [&](const PathSampler& sampler, passes::Surface& surface) {
                const auto u = sampler.pair(in_pixel);
                return at_surface(w.corner + u.x * w.u + u.y * w.v, w.normal(), w.albedo, surface);
            },
            mixed(seed + 1000 * i), points);
        // Radiance L of what a wall reflects: ρ E = π L, and it absorbs (1 - ρ) E.
        watts += (1 - w.albedo) / w.albedo * pi * w.area() * estimate(pixel.sums, points, 0).mean;
    }
    const auto through = trace_pixel(
        reflected,
        [](const PathSampler& sampler, passes::Surface&) {
            // Cosine-distributed about -z at a point of the opening: flux = π mean L.
            const auto at = sampler.pair(in_pixel), u = sampler.pair(1000);
            const float r = std::sqrt(u.x), phi = glm::two_pi<float>() * u.y;
            return ray({at.x, at.y, 1}, {r * std::cos(phi), r * std::sin(phi), -std::sqrt(1 - u.x)});
        },
        mixed(seed + 999999), points);
    return (watts + pi * estimate(through.sums, points, 0).mean) / room.emitted();
}

std::vector<Estimate> balances(const Estimator& estimator) {
    const OpenRoom room;
    const auto world = room.lab.world(Transport::Materials::lambert);
    std::vector<Estimate> result;
    for (int seed = 0; seed < seeds; ++seed) result.push_back({balance(room, world, estimator, seed), 0});
    return result;
}

TEST(ReferenceEnergy, WhatIsEmittedIsAbsorbedOrEscapes) {
    const auto found = balances({});
    EXPECT_LT(std::abs(t_of(found, 1)), critical_t) << spread(found).mean;
    EXPECT_LT(spread(found).variance / seeds, 0.01 * 0.01) << "the test has no power";
}

TEST(ReferenceEnergy, RejectsRouletteWithoutCompensation) {
    Estimator mutant;
    mutant.compensate = without_compensation;
    EXPECT_GT(std::abs(t_of(balances(mutant), 1)), critical_t);
}

/// Mean of the estimated variances over the variance between 12,000 seeds. The latter is known to 1.3 %, the
/// former (7 degrees of freedom each) to 0.5 %: 3.9 standard deviations (α = 1e-4) are 5.5 %.
constexpr int many_seeds = 12000;
constexpr double variance_tolerance = 0.055;
double variance_ratio(const std::vector<Estimate>& found) {
    double mean = 0;
    for (const auto& e : found) mean += e.variance / static_cast<double>(found.size());
    return mean / spread(found).variance;
}

TEST(ReferenceEnergy, VarianceIsThatBetweenSeeds) {
    const OpenRoom room;
    const auto seen = [](auto&, auto&) { return ray({0.5f, 0.5f, 3}, {0.05f, -0.12f, -1}); };
    for (const std::uint64_t n : {8, 16}) {
        const auto found = estimates(room.lab, transport(Paths::full, 1, 4), seen, many_seeds, n);
        const double ratio = variance_ratio(found);
        EXPECT_NEAR(ratio, 1, variance_tolerance) << n << " samples";
        // Mutant: divided by the number of randomisations instead of the degrees of freedom.
        EXPECT_GT(std::abs(7.0 / 8 * ratio - 1), variance_tolerance);
    }
}

TEST(ReferencePaths, DoNotDependOnThoseBesideThem) {
    const OpenRoom room;
    const auto world = room.lab.world(Transport::Materials::lambert);
    Wavefront wavefront(world, PathRules(transport(Paths::full, 1, 6)));
    const Starter seen = [](const PathSampler& sampler, passes::Surface&) {
        const auto u = sampler.pair(in_pixel);
        return ray({0.5f, 0.5f, 3}, {u.x - 0.5f, u.y - 0.5f, -2.5f});
    };
    const auto whole = trace_pixel(wavefront, seen, 7, 400);
    for (const auto& [first, count] : {std::pair{0, 5}, {5, 11}, {16, 384}, {123, 1}}) {
        const auto part = trace_pixel(wavefront, seen, 7, count, first);
        for (int i = 0; i < count; ++i) {
            EXPECT_EQ(part.lights[i].seen, whole.lights[first + i].seen);
            EXPECT_EQ(part.lights[i].direct, whole.lights[first + i].direct);
            EXPECT_EQ(part.lights[i].indirect, whole.lights[first + i].indirect);
        }
    }
}

/// Notes of a picture of a plane of this material under a point light.
std::string notes_of(const scene::Material& material, Transport::Materials model) {
    scene::Scene scene;
    scene.materials = {material};
    scene::World world;
    world.ranges = {{0, 0, 2}};
    world.lights.emplace_back();
    graph::FrameInputs inputs;
    inputs.scene = &scene;
    inputs.world = &world;
    const MethodDescription method;
    graph::GraphBuilder builder(method, inputs, 1, 0);
    Parameters parameters;
    parameters.transport = transport(Paths::full, 1, 1, model);
    note_limits(builder, parameters, sharp_materials(scene, model));
    std::string all;
    for (const auto& note : builder.notes()) all += note;
    return all;
}

TEST(ReferencePaths, CausticsOfPointLightsAreSaidToBeMissing) {
    scene::Material rough, mirror, glass;
    rough.roughness = 0.2f;
    mirror.roughness = 0;
    glass.transmission = 1;
    EXPECT_EQ(notes_of(glass, Transport::Materials::gltf), "") << "rough glass scatters";
    glass.roughness = 0;
    EXPECT_EQ(notes_of(rough, Transport::Materials::gltf), "");
    EXPECT_NE(notes_of(mirror, Transport::Materials::gltf), "");
    EXPECT_NE(notes_of(glass, Transport::Materials::gltf), "");
    EXPECT_EQ(notes_of(glass, Transport::Materials::lambert), "");
    mirror.metallic = 0;  // then the blend has no highlight
    EXPECT_EQ(notes_of(mirror, Transport::Materials::metalness_blend), "");
}

TEST(ReferencePaths, CutsAreCounted) {
    // Between two facing mirrors no path ends.
    Lab lab;
    scene::Material mirror;
    mirror.roughness = 0;
    const int m = lab.material(mirror);
    lab.quad(m, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    lab.quad(m, {-5, 1, 5}, {10, 0, 0}, {0, 0, -10});
    lab.environment(glm::vec3(1));
    lab.build();
    const auto world = lab.world(Transport::Materials::gltf);
    Wavefront wavefront(world, PathRules(transport(Paths::full, 1, 1, Transport::Materials::gltf)));
    const auto pixel = trace_pixel(
        wavefront,
        [](auto&, auto&) {
            return ray({0, 0.5f, 0}, {0.01f, -1, 0});
        },
        1, 16);
    EXPECT_EQ(wavefront.counts().cut, 16u);
    EXPECT_EQ(pixel.sums[0], 0);
}

}  // namespace
}  // namespace ir::methods::reference
