#include <gtest/gtest.h>
#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/passes/bsdf_fixture.h"

namespace ir::test {
namespace {

/// Fraction of `steps` equal steps of the choice in which light passes.
double transmitted_fraction(const Patch& patch, glm::vec3 wo, int steps = 100000) {
    const auto bsdf = patch.bsdf();
    int transmitted = 0;
    for (int i = 0; i < steps; ++i) {
        const auto s = bsdf.sample(wo, (static_cast<float>(i) + 0.5f) / static_cast<float>(steps), {0, 0});
        if (!s) continue;
        EXPECT_TRUE(s->is_specular);
        transmitted += s->is_transmitted;
    }
    return static_cast<double>(transmitted) / steps;
}

TEST(Glass, ReflectanceIsTheMeanOfBothPolarisations) {
    // Fresnel's equations by angles: r_s = -sin(i - t)/sin(i + t), r_p = tan(i - t)/tan(i + t)
    for (const double degrees : {10.0, 45.0, 56.30993, 80.0}) {
        const double i = glm::radians(degrees), t = std::asin(std::sin(i) / 1.5);
        const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
        const auto found = passes::dielectric_fresnel(static_cast<float>(std::cos(i)), 1.5f);
        EXPECT_NEAR(found.reflectance, (s * s + p * p) / 2, 1e-6) << degrees;
        EXPECT_NEAR(found.refracted_cosine, std::cos(t), 1e-6) << degrees;
        const auto back = passes::dielectric_fresnel(static_cast<float>(std::cos(t)), 1 / 1.5f);
        EXPECT_NEAR(back.reflectance, found.reflectance, 1e-5) << "the same from within";
    }
    EXPECT_NEAR(passes::dielectric_fresnel(1, 1.5f).reflectance, 0.04, 1e-6);
    EXPECT_EQ(passes::dielectric_fresnel(0.5f, 1).reflectance, 0);
    EXPECT_EQ(passes::dielectric_fresnel(0.5f, 0).reflectance, 1);
}

TEST(Glass, IsChosenByFresnel) {
    for (const float cosine : {0.1f, 0.4f, 1.0f}) {
        const auto volume = glass(1), sheet = glass(0);
        const auto wo = volume.direction(cosine);
        const double f = passes::dielectric_fresnel(cosine, 1.5f).reflectance;
        EXPECT_NEAR(transmitted_fraction(volume, wo), 1 - f, 2e-5);
        EXPECT_NEAR(transmitted_fraction(sheet, wo), (1 - f) / (1 + f), 2e-5);
    }
}

TEST(Glass, ASheetCountsAllReflectionsBetweenItsSides) {
    const double f = 0.2;
    double reflected = f, inside = 1 - f;
    for (int i = 0; i < 40; ++i) {  // inside: light on its way to the front, then to the back
        inside *= f;
        reflected += inside * (1 - f);
        inside *= f;
    }
    EXPECT_NEAR(passes::sheet_reflectance(0.2f), reflected, 1e-6);
}

TEST(Glass, RefractsBySnellsLawAndBack) {
    auto patch = glass(1);
    const auto n = patch.surface.shading_normal_ws;
    const auto wo = patch.direction(0.6f, 1.1f);
    const auto in = patch.bsdf().sample(wo, 0.9f, {0, 0});
    ASSERT_TRUE(in && in->is_transmitted);
    EXPECT_EQ(in->pdf, 0);
    EXPECT_NEAR(glm::length(in->wi), 1, 1e-6f);
    EXPECT_LT(glm::dot(in->wi, n), 0);
    EXPECT_NEAR(glm::length(glm::cross(in->wi, n)), 0.8f / 1.5f, 1e-6f);
    EXPECT_NEAR(glm::dot(glm::cross(in->wi, wo), n), 0, 1e-6f) << "leaves the plane of incidence";
    EXPECT_LT(glm::dot(in->wi - glm::dot(in->wi, n) * n, wo), 0) << "turns back";
    EXPECT_LT(glm::distance(in->weight, patch.surface.base_colour / 2.25f), 1e-6f);

    patch.surface.is_front = false;
    patch.surface.geometric_normal_ws = patch.surface.shading_normal_ws = -n;
    const auto out = patch.bsdf().sample(in->wi, 0.9f, {0, 0});
    ASSERT_TRUE(out && out->is_transmitted);
    EXPECT_LT(glm::distance(out->wi, wo), 1e-5f);
    EXPECT_LT(glm::distance(out->weight, patch.surface.base_colour * 2.25f), 1e-5f);
}

TEST(Glass, ReflectsTotallyFromWithin) {
    auto patch = glass(1);
    patch.surface.is_front = false;
    const float critical = std::sqrt(1 - 1 / 2.25f);
    EXPECT_EQ(transmitted_fraction(patch, patch.direction(critical - 1e-3f)), 0);
    EXPECT_GT(transmitted_fraction(patch, patch.direction(critical + 1e-3f)), 0.1);
    EXPECT_GT(transmitted_fraction(glass(0), patch.direction(0.1f)), 0.1) << "a sheet has no inside";
}

/// In a furnace of radiance 1 outside and η² inside (the same L/n² everywhere), clear glass shows nothing:
/// what leaves is n² of its own side.
TEST(Glass, VanishesInAFurnace) {
    for (const bool is_front : {true, false})
        for (const float cosine : {0.05f, 0.3f, 0.8f, 1.0f}) {
            auto patch = glass(1);
            patch.surface.base_colour = glm::vec3(1);
            patch.surface.is_front = is_front;
            const auto bsdf = patch.bsdf();
            const float own = is_front ? 1.0f : 2.25f, other = is_front ? 2.25f : 1.0f;
            for (int i = 0; i < 100; ++i) {
                const auto s = bsdf.sample(patch.direction(cosine), (i + 0.5f) / 100, {0, 0});
                ASSERT_TRUE(s);
                EXPECT_NEAR(s->weight.x * (s->is_transmitted ? other : own), own, 1e-5f);
            }
        }
}

TEST(Glass, ASheetDoesNotBend) {
    const auto patch = glass(0);
    const auto wo = patch.direction(0.3f);
    const auto s = patch.bsdf().sample(wo, 0.999f, {0, 0});
    ASSERT_TRUE(s && s->is_transmitted);
    EXPECT_EQ(s->wi, -wo);
    EXPECT_EQ(s->weight, patch.surface.base_colour);
    const auto r = patch.bsdf().sample(wo, 0, {0, 0});
    ASSERT_TRUE(r && !r->is_transmitted);
    EXPECT_EQ(r->weight, glm::vec3(1)) << "reflections have no tint";
}

TEST(Glass, HasNoSmoothPartUnlessPartial) {
    EXPECT_FALSE(glass(1).bsdf().has_smooth_part());
    EXPECT_EQ(glass(1).bsdf().pdf(glass(1).direction(0.5f), glass(1).direction(0.5f)), 0);
    const auto half = glass(0, 0.25f), opaque = glass(0, 0);
    EXPECT_TRUE(half.bsdf().has_smooth_part());
    const auto wo = half.direction(0.5f), wi = half.direction(0.7f, 2);
    EXPECT_LT(glm::distance(half.bsdf().evaluate(wo, wi), 0.75f * opaque.bsdf().evaluate(wo, wi)), 1e-6f);
    EXPECT_FLOAT_EQ(half.bsdf().pdf(wo, wi), 0.75f * opaque.bsdf().pdf(wo, wi));
    int transmitted = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto s = half.bsdf().sample(wo, (i + 0.5f) / 1000, {0.3f, 0.3f});
        ASSERT_TRUE(s);
        transmitted += s->is_transmitted;
    }
    const double f = passes::dielectric_fresnel(0.5f, 1.5f).reflectance;
    EXPECT_NEAR(transmitted / 1000.0, 0.25 * (1 - f) / (1 + f), 2e-3);
}

TEST(Glass, MetalDoesNotTransmit) {
    auto patch = glass(1);
    patch.surface.metallic = 1;
    EXPECT_EQ(transmitted_fraction(patch, patch.direction(0.5f), 100), 0);
}

TEST(Glass, TransmittanceFollowsBeersLaw) {
    scene::Material material;
    material.attenuation_colour = {0.5f, 0.25f, 0};
    material.attenuation_distance = 2;
    EXPECT_EQ(passes::Bsdf::transmittance(material, 4), glm::vec3(1)) << "a sheet has no volume";
    material.thickness = 1;
    const auto found = passes::Bsdf::transmittance(material, 4);
    EXPECT_LT(glm::distance(found, {0.25f, 0.0625f, 0}), 1e-6f);
    EXPECT_EQ(passes::Bsdf::transmittance(material, 0), glm::vec3(1));
    material.attenuation_distance = 0;
    EXPECT_EQ(passes::Bsdf::transmittance(material, 4), glm::vec3(1)) << "0 is infinite";
}

/// Rough glass of this roughness in place of smooth.
Patch rough(float thickness, float roughness) {
    auto patch = glass(thickness);
    patch.surface.base_colour = glm::vec3(1);
    patch.surface.roughness = roughness;
    return patch;
}

glm::vec3 on_sphere(std::mt19937& random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const float z = 2 * unit(random) - 1, r = std::sqrt(1 - z * z), phi = glm::two_pi<float>() * unit(random);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

/// In a furnace of radiance 1 outside and η² inside rough glass loses only what microfacets would scatter
/// more than once, and gains nothing.
TEST(RoughGlass, ShowsAFurnaceAlmostWhole) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const float thickness : {0.0f, 1.0f})
        for (const bool is_front : {true, false})
            for (const auto& [roughness, least] : {std::pair{0.1f, 0.995}, {0.4f, 0.92}, {0.7f, 0.65}}) {
                auto patch = rough(thickness, roughness);
                patch.surface.is_front = is_front;
                const float inside = thickness > 0 ? 2.25f : 1.0f;
                const float own = is_front ? 1 : inside, other = is_front ? inside : 1;
                double sum = 0;
                constexpr int n = 40000;
                for (int i = 0; i < n; ++i) {
                    const auto s = patch.bsdf().sample(patch.direction(0.7f), unit(random),
                                                       {unit(random), unit(random)});
                    if (!s) continue;
                    ASSERT_FALSE(s->is_specular);
                    sum += s->weight.x * (s->is_transmitted ? other : own) / own;
                }
                EXPECT_GT(sum / n, least) << thickness << " " << is_front << " " << roughness;
                EXPECT_LT(sum / n, 1.001) << thickness << " " << is_front << " " << roughness;
                // A sheet sends on what a white metal of its roughness reflects, to either side.
                Patch metal;
                metal.surface.metallic = 1, metal.surface.roughness = roughness;
                metal.surface.base_colour = glm::vec3(1);
                if (thickness == 0 && roughness > 0.3f) {
                    EXPECT_NEAR(sum / n, directional_albedo(metal, metal.direction(0.7f)), 0.01) << roughness;
                }
            }
}

/// Samples, densities and values over the whole sphere say the same.
TEST(RoughGlass, SamplesAsItsDensitySays) {
    std::mt19937 random(6);
    std::uniform_real_distribution<float> unit(0, 1);
    for (const float thickness : {0.0f, 1.0f})
        for (const bool is_front : {true, false}) {
            auto patch = rough(thickness, 0.7f);
            patch.surface.is_front = is_front;
            const auto bsdf = patch.bsdf();
            const auto wo = patch.direction(0.6f);
            constexpr int n = 400000;
            double drawn = 0, through = 0, weight = 0, density = 0, density_through = 0, value = 0;
            for (int i = 0; i < n; ++i) {
                if (const auto s = bsdf.sample(wo, unit(random), {unit(random), unit(random)})) {
                    drawn += 1.0 / n, weight += s->weight.x / n;
                    through += s->is_transmitted ? 1.0 / n : 0;
                }
                const auto wi = on_sphere(random);
                const auto at = bsdf.evaluate_with_pdf(wo, wi);
                constexpr double sphere = 4 * glm::pi<double>();
                density += sphere * at.pdf / n, value += sphere * at.value.x / n;
                if (glm::dot(wi, patch.surface.shading_normal_ws) < 0) density_through += sphere * at.pdf / n;
            }
            EXPECT_NEAR(density, drawn, 0.02) << thickness << " " << is_front;
            EXPECT_NEAR(density_through, through, 0.02) << thickness << " " << is_front;
            EXPECT_NEAR(value, weight, 0.02 * weight) << thickness << " " << is_front;
        }
}

/// What comes from light sources sees the same surface as what goes to the camera, from the other side, too.
TEST(RoughGlass, CarriesPowerAsItCarriesRadiance) {
    std::mt19937 random(7);
    for (const float thickness : {0.0f, 1.0f}) {
        const auto front = rough(thickness, 0.6f);
        auto back = front;
        back.surface.is_front = false;
        back.surface.geometric_normal_ws *= -1.0f, back.surface.shading_normal_ws *= -1.0f;
        const auto n = front.surface.geometric_normal_ws;
        int compared = 0;
        for (int i = 0; i < 5000; ++i) {
            const auto wi = on_sphere(random), wo = on_sphere(random);
            if (glm::dot(wi, n) < 0.1f) continue;
            const bool is_behind = glm::dot(wo, n) < 0;
            const auto radiance = (is_behind ? back : front).bsdf().evaluate(wo, wi).x;
            const auto power = front.bsdf().evaluate_importance(wi, wo).x;
            const float expected = radiance * std::abs(glm::dot(n, wo)) / glm::dot(n, wi);
            EXPECT_NEAR(power, expected, 1e-3f * expected + 1e-6f) << thickness << " " << is_behind;
            compared += is_behind && expected > 0;
        }
        EXPECT_GT(compared, 100);
    }
}

TEST(RoughGlass, TurnsIntoSmoothGlass) {
    const auto patch = rough(1, 0.035f);
    const auto wo = patch.direction(0.6f);
    const auto smooth = glass(1).bsdf().sample(wo, 0.9f, {0, 0});
    const auto found = patch.bsdf().sample(wo, 0.9f, {0.2f, 0.7f});
    ASSERT_TRUE(found && smooth && found->is_transmitted);
    EXPECT_LT(glm::distance(found->wi, smooth->wi), 0.01f);
    EXPECT_NEAR(found->weight.x, 1 / 2.25f, 1e-3f);
}

}  // namespace
}  // namespace ir::test
