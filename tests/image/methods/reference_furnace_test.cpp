// White furnaces: surfaces under light from everywhere. Each mean is that of 64 independent furnace_seeds
// with 64 furnace_samples (4096 paths); t has 63 degrees of freedom. The comparisons of this file are 20: |t|
// < 5.2 holds for each with α = 1e-4 / 20 two-sided (2.3e-6 at 5.2).
#include <gtest/gtest.h>

#include "renderers/passes/scattering/bsdf.h"
#include "tests/image/methods/reference_lab.h"

namespace ir::methods::reference {
namespace {

using Paths = Transport::Paths;
using Materials = Transport::Materials;
constexpr double critical_t_of_furnaces = 5.2;
constexpr int furnace_seeds = 64;
constexpr std::uint64_t furnace_samples = 64;

/// A sphere of one material under a constant environment.
Lab sphere_lab(const scene::Material& material, int splits = 3) {
    Lab lab;
    lab.sphere(lab.material(material), 1, splits);
    lab.environment(glm::vec3(1));
    lab.build();
    return lab;
}

scene::Material diffuse(float albedo) {
    scene::Material m;
    m.base_colour = glm::vec4(glm::vec3(albedo), 1);
    m.metallic = 0;
    return m;
}

scene::Material metal(float roughness) {
    scene::Material m;
    m.metallic = 1;
    m.roughness = roughness;
    return m;
}

/// Onto the sphere, beside its middle, not at an edge.
const Starter onto_sphere = [](const PathSampler&, passes::Surface&) {
    return ray({0.31f, 0.23f, 3}, {0, 0, -1});
};

TEST(ReferenceFurnace, DiffuseReflectsItsAlbedo) {
    for (const float albedo : {0.5f, 1.0f}) {
        const auto lab = sphere_lab(diffuse(albedo));
        for (const auto paths : {Paths::direct, Paths::full}) {
            const auto found =
                estimates(lab, transport(paths, 1, 5), onto_sphere, furnace_seeds, furnace_samples);
            EXPECT_LT(std::abs(t_of(found, albedo)), critical_t_of_furnaces) << albedo;
        }
    }
}

TEST(ReferenceFurnace, RejectsLightThatIsCountedTwice) {
    const auto lab = sphere_lab(diffuse(0.5f));
    Estimator mutant;
    mutant.combine = without_weights;
    const auto found =
        estimates(lab, transport(Paths::direct), onto_sphere, furnace_seeds, furnace_samples, mutant);
    EXPECT_GT(std::abs(t_of(found, 0.5)), critical_t_of_furnaces);
}

/// ∫ f cosθ dω by the midpoint rule in μ² and φ: independent of how directions are sampled.
double directional_albedo(const passes::Bsdf& bsdf, glm::vec3 n, glm::vec3 wo) {
    const auto tangent = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.8f, -0.5f)));
    const auto bitangent = glm::cross(n, tangent);
    constexpr int rings = 1500, sectors = 1500;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double mu = (i + 0.5) / rings, s = std::sqrt(1 - mu * mu);
        for (int k = 0; k < sectors; ++k) {
            const double phi = glm::two_pi<double>() * (k + 0.5) / sectors;
            const auto wi = static_cast<float>(mu) * n + static_cast<float>(s * std::cos(phi)) * tangent +
                            static_cast<float>(s * std::sin(phi)) * bitangent;
            sum += bsdf.evaluate(wo, glm::normalize(wi)).r;
        }
    }
    return sum * glm::two_pi<double>() / (static_cast<double>(rings) * sectors);
}

/// On the plane y = 0 at an angle with cos θ = `cosine`.
Starter onto_plane(float cosine) {
    return [=](const PathSampler&, passes::Surface&) {
        const glm::vec3 wo(std::sqrt(1 - cosine * cosine), cosine, 0);
        return ray(wo, -wo);
    };
}

TEST(ReferenceFurnace, GgxReflectsItsDirectionalAlbedo) {
    for (const float roughness : {0.25f, 0.5f, 1.0f}) {
        Lab lab;
        lab.quad(lab.material(metal(roughness)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
        lab.environment(glm::vec3(1));
        lab.build();
        for (const float cosine : {0.2f, 0.9f}) {
            passes::Surface surface;
            surface.geometric_normal_ws = surface.shading_normal_ws = {0, 1, 0};
            surface.metallic = 1, surface.roughness = roughness;
            const passes::Bsdf bsdf(surface, metal(roughness), Materials::gltf);
            const double expected =
                directional_albedo(bsdf, {0, 1, 0}, {std::sqrt(1 - cosine * cosine), cosine, 0});
            const auto found = estimates(lab, transport(Paths::direct, 1, 1, Materials::gltf),
                                         onto_plane(cosine), furnace_seeds, furnace_samples);
            EXPECT_LE(expected, 1 + 1e-4);
            // 1e-4: of the quadrature.
            EXPECT_LT(
                std::abs(t_of(found, expected)),
                critical_t_of_furnaces + 1e-4 / std::sqrt(spread(found).variance / furnace_seeds + 1e-12))
                << roughness << " " << cosine << ": " << spread(found).mean << " for " << expected;
        }
    }
}

TEST(ReferenceFurnace, RejectsTheAlbedoOfAnotherRoughness) {
    Lab lab;
    lab.quad(lab.material(metal(0.5f)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    lab.environment(glm::vec3(1));
    lab.build();
    passes::Surface surface;
    surface.geometric_normal_ws = surface.shading_normal_ws = {0, 1, 0};
    surface.metallic = 1, surface.roughness = 0.6f;
    const passes::Bsdf bsdf(surface, metal(0.6f), Materials::gltf);
    const double wrong = directional_albedo(bsdf, {0, 1, 0}, {std::sqrt(1 - 0.04f), 0.2f, 0});
    const auto found = estimates(lab, transport(Paths::direct, 1, 1, Materials::gltf), onto_plane(0.2f),
                                 furnace_seeds, furnace_samples);
    EXPECT_GT(std::abs(t_of(found, wrong)), critical_t_of_furnaces);
}

scene::Material glass() {
    scene::Material m = diffuse(1);
    m.roughness = 0;
    m.transmission = 1;
    m.thickness = 1;
    return m;
}

TEST(ReferenceFurnace, GlassLosesNothing) {
    const auto lab = sphere_lab(glass(), 5);
    const auto found = estimates(lab, transport(Paths::full, 1, 3, Materials::gltf), onto_sphere,
                                 furnace_seeds, furnace_samples);
    EXPECT_LT(std::abs(t_of(found, 1)), critical_t_of_furnaces) << spread(found).mean;
}

TEST(ReferenceFurnace, GlassTestRejectsAbsorption) {
    auto material = glass();
    material.attenuation_colour = glm::vec3(0.99f);
    material.attenuation_distance = 1;
    const auto lab = sphere_lab(material, 5);
    const auto found = estimates(lab, transport(Paths::full, 1, 3, Materials::gltf), onto_sphere,
                                 furnace_seeds, furnace_samples);
    EXPECT_GT(std::abs(t_of(found, 1)), critical_t_of_furnaces);
}

/// Within a closed convex room of albedo ρ and emission 1, n scatterings bring ρⁿ.
Lab closed_room(float albedo) {
    Lab lab;
    lab.sphere(lab.material(glm::vec3(albedo), glm::vec3(1)), -1, 2);
    lab.build();
    return lab;
}
const Starter inside = [](const PathSampler&, passes::Surface&) {
    return ray({0.1f, 0.2f, -0.05f}, {0.3f, 0.5f, 0.9f});
};

double powers(double albedo, int from, int to) {
    double sum = 0;
    for (int k = from; k <= to; ++k) sum += std::pow(albedo, k);
    return sum;
}

TEST(ReferenceFurnace, ClosedRoomSumsThePowersOfItsAlbedo) {
    for (const float albedo : {0.5f, 0.9f}) {
        const auto lab = closed_room(albedo);
        const auto check = [&](const Transport& t, double expected) {
            const auto found = estimates(lab, t, inside, furnace_seeds, furnace_samples);
            EXPECT_LT(std::abs(t_of(found, expected)), critical_t_of_furnaces)
                << spread(found).mean << " " << expected;
        };
        check(transport(Paths::direct), albedo);
        check(transport(Paths::indirect, 1, 1), powers(albedo, 2, 2));
        check(transport(Paths::indirect, 3, 7), powers(albedo, 4, 8));
        check(transport(Paths::full, 1, 7), powers(albedo, 0, 8));
        check(transport(Paths::full, 2, 7), powers(albedo, 0, 1) + powers(albedo, 3, 8));
    }
}

TEST(ReferenceFurnace, RejectsRouletteWithoutCompensation) {
    const auto lab = closed_room(0.5f);
    Estimator mutant;
    mutant.compensate = without_compensation;
    const auto found =
        estimates(lab, transport(Paths::full, 1, 7), inside, furnace_seeds, furnace_samples, mutant);
    EXPECT_GT(std::abs(t_of(found, powers(0.5, 0, 8))), critical_t_of_furnaces);
}

TEST(ReferenceFurnace, DistancesBetweenScatteringsAreLimited) {
    // Chords of the unit sphere from a fixed point, Lambert-distributed, have lengths 2 μ with density 2 μ:
    // a part (d/2)² is shorter than d. The polygon is not quite a sphere: 4 splits, 1 % of tolerance in d.
    Lab lab;
    lab.sphere(lab.material(glm::vec3(0.8f), glm::vec3(1)), -1, 4);
    lab.build();
    auto t = transport(Paths::indirect, 1, 1);
    t.max_distance = 1;
    const auto found = estimates(lab, t, inside, furnace_seeds, furnace_samples);
    EXPECT_NEAR(spread(found).mean, 0.8 * 0.8 * 0.25, 0.01);
    t.max_distance = 2.01f;
    EXPECT_NEAR(spread(estimates(lab, t, inside, furnace_seeds, furnace_samples)).mean, 0.8 * 0.8, 0.01);
}

/// A ball of rough glass in a furnace loses only what microfacets scatter more than once; by paths that meet
/// the sky alone, and by those that choose it, too.
TEST(ReferenceFurnace, RoughGlassAlmostVanishes) {
    scene::Material glass;
    glass.metallic = 0, glass.transmission = 1, glass.thickness = 1;
    glass.roughness = 0.3f;
    const auto lab = sphere_lab(glass, 2);
    const auto paths = transport(Paths::full, 1, 30, Materials::gltf);
    const auto found = estimates(lab, paths, onto_sphere, furnace_seeds, furnace_samples);
    EXPECT_GT(spread(found).mean, 0.93);
    EXPECT_LT(spread(found).mean, 1 + 5 * std::sqrt(spread(found).variance / furnace_seeds));
    Estimator by_rays;
    by_rays.combine = [](float pdf, float other) { return pdf > other ? 1.0f : pdf < other ? 0.0f : 0.5f; };
    const auto other = estimates(lab, paths, onto_sphere, furnace_seeds, furnace_samples, by_rays);
    const double error = std::sqrt((spread(found).variance + spread(other).variance) / furnace_seeds);
    EXPECT_NEAR(spread(found).mean, spread(other).mean, critical_t_of_furnaces * error)
        << "any weights that add up to 1 give the same";
    Estimator mutant;
    mutant.combine = without_weights;
    EXPECT_GT(spread(estimates(lab, paths, onto_sphere, furnace_seeds, furnace_samples, mutant)).mean, 1.05);
}

}  // namespace
}  // namespace ir::methods::reference
