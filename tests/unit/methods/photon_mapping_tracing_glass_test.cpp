// Photons on their way through glass, against closed forms: Fresnel's equations, Snell's law, Beer's law.
#include <cmath>

#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/methods/photon_mapping_tracing_fixture.h"

namespace ir::test {
namespace {

using methods::photon_mapping::Tracer;

constexpr int photons_sent = 20000;
constexpr auto clear_glass = static_cast<SmallWorld::Material>(2);
/// Where a slab begins and ends above the floor, m; a sheet has its upper side alone.
constexpr float upper = 1, lower = 0.5f;

class PhotonsInGlass : public TracingTest, public testing::WithParamInterface<Tracer> {
  protected:
    /// A wide slab or sheet of clear glass over a black floor.
    static Shot over_floor(bool is_slab, glm::vec3 tint = glm::vec3(1),
                           glm::vec3 attenuation = glm::vec3(1)) {
        SmallWorld world;
        world.square({0, 0, 0}, {0, 1, 0}, 50);
        world.square({0, upper, 0}, {0, 1, 0}, 50, clear_glass);
        if (is_slab) world.square({0, lower, 0}, {0, -1, 0}, 50, clear_glass);
        auto scene = world.scene();
        scene.materials[0].base_colour = {0, 0, 0, 1};
        scene.materials[0].metallic = 0;
        auto& material = scene.materials.emplace_back();
        material.base_colour = glm::vec4(tint, 1);
        material.metallic = material.roughness = 0;
        material.transmission = 1;
        material.thickness = is_slab ? 1.0f : 0.0f;
        material.attenuation_colour = attenuation;
        material.attenuation_distance = 0.5f;
        return {scene, scene.cameras[0], 8, 8};
    }
    static Parameters all_light() {
        auto parameters = plain(1);
        parameters.transport.materials = Transport::Materials::gltf;
        parameters.transport.paths = Transport::Paths::full;
        parameters.tracer = GetParam();
        return parameters;
    }
    static glm::vec3 downwards(double degrees) {
        const auto angle = static_cast<float>(glm::radians(degrees));
        return {std::sin(angle), -std::cos(angle), 0};
    }

    /// What comes to the floor before anything scatters it.
    struct Arrived {
        double count = 0;
        glm::dvec3 power{0};  ///< over what was sent
        glm::vec3 place{0};   ///< of the photon that was weakened least
        float distance = 0;   ///< that photon's, m since the first glass
    };
    Arrived on_floor(const Shot& shot, glm::vec3 from, glm::vec3 direction) {
        FirstHit hit;
        hit.position_ws = from;
        hit.normal_ws = {0, 1, 0};
        hit.arrived_from = -direction;
        std::vector<SamplePoint> points;
        for (std::uint32_t i = 0; i < photons_sent; ++i) {
            points.push_back(sample_point(hit, i));
            points.back().light |= methods::photon_mapping::leaves_along_ray;
        }
        const auto outcome = trace(shot, points, all_light());
        Arrived arrived;
        double strongest = 0;
        for (const auto& photon : outcome.photons) {
            if ((photon.bits >> 2 & 15) != 0) continue;
            EXPECT_LT(std::abs(photon.position_ws.y), 1e-4f) << "stored on glass";
            const glm::dvec3 power(methods::photon_mapping::unpacked_power(photon.power));
            ++arrived.count;
            arrived.power += power / double(photons_sent);
            if (power.r <= strongest) continue;
            strongest = power.r;
            arrived.place = photon.position_ws;
            arrived.distance = photon.ray_length;
        }
        return arrived;
    }
    /// Of `photons_sent` Bernoulli trials, alpha = 1e-4 over 48 comparisons (z = 4.9); and half of RGB9E5's
    /// 256 steps.
    static double tolerance(double part) {
        return 4.9 * std::sqrt(part * (1 - part) / photons_sent) + 0.002 * part;
    }
};

struct Interface {
    double fresnel, refracted_cosine;
    explicit Interface(double degrees) {
        const double cosine = std::cos(glm::radians(degrees)), sine = std::sin(glm::radians(degrees));
        refracted_cosine = std::sqrt(1 - sine * sine / 2.25);
        const double s = (cosine - 1.5 * refracted_cosine) / (cosine + 1.5 * refracted_cosine);
        const double p = (1.5 * cosine - refracted_cosine) / (1.5 * cosine + refracted_cosine);
        fresnel = (s * s + p * p) / 2;
    }
};

TEST_P(PhotonsInGlass, PassASlabByFresnelSnellAndBeer) {
    const glm::vec3 attenuation(0.9f, 0.6f, 0.3f);
    for (const double degrees : {0.0, 45.0, 75.0}) {
        const auto direction = downwards(degrees);
        const Interface interface(degrees);
        const auto found = on_floor(over_floor(true, glm::vec3(1), attenuation), {0, 2, 0}, direction);
        for (int c = 0; c < 3; ++c) {
            const double inside =
                std::pow(double(attenuation[c]), 1 / interface.refracted_cosine);  // 0.5 m thick
            const double f = interface.fresnel, g = f * inside;
            const double expected = (1 - f) * (1 - f) * inside / (1 - g * g);
            EXPECT_NEAR(found.power[c], expected, tolerance(expected)) << degrees << "° channel " << c;
            // mutants: without Beer's law, and with the index of air on both sides
            EXPECT_GT(std::abs(found.power[c] - (1 - f) / (1 + f)), tolerance(expected));
            EXPECT_GT(std::abs(found.power[c] - attenuation[c]), tolerance(expected));
        }
        const double tangent = std::tan(glm::radians(degrees)),
                     within = std::sqrt(1 / (interface.refracted_cosine * interface.refracted_cosine) - 1);
        EXPECT_NEAR(found.place.x, 1.5 * tangent + 0.5 * within, 2e-3) << degrees << "°";
        EXPECT_NEAR(found.distance, 0.5 / interface.refracted_cosine + 0.5 / std::cos(glm::radians(degrees)),
                    2e-3);
    }
}

TEST_P(PhotonsInGlass, PassASheetStraightOnTintedOnce) {
    const glm::vec3 tint(0.8f, 0.5f, 0.2f);
    for (const double degrees : {0.0, 60.0}) {
        const auto found =
            on_floor(over_floor(false, tint, {0.1f, 0.1f, 0.1f}), {0, 2, 0}, downwards(degrees));
        const double f = Interface(degrees).fresnel, passing = (1 - f) / (1 + f);
        for (int c = 0; c < 3; ++c) {
            // the roulette leaves those that pass with the strongest channel's probability
            const double expected = passing * tint[c];
            EXPECT_NEAR(found.power[c], expected, tolerance(passing * 0.8) * tint[c] / 0.8) << degrees;
        }
        EXPECT_NEAR(found.place.x, 2 * std::tan(glm::radians(degrees)), 2e-3) << degrees;
        EXPECT_NEAR(found.count / photons_sent, passing * 0.8, tolerance(passing * 0.8)) << degrees;
    }
}

/// Light that starts within the slab: beyond the critical angle of 41.8° none gets out, below it all does at
/// last.
TEST_P(PhotonsInGlass, AreReflectedTotallyFromWithin) {
    const auto slab = over_floor(true);
    EXPECT_EQ(on_floor(slab, {0, 0.75f, 0}, downwards(43)).count, 0);
    const double outside = std::asin(1.5 * std::sin(glm::radians(30.0)));
    const double f = Interface(glm::degrees(outside)).fresnel;
    const auto found = on_floor(slab, {0, 0.75f, 0}, downwards(30));
    EXPECT_NEAR(found.power.r, 1 / (1 + f), tolerance(1 / (1 + f)));
    const auto dark = on_floor(over_floor(true, glm::vec3(1), glm::vec3(0.25f)), {0, 0.75f, 0}, downwards(0));
    const double inside = std::sqrt(0.25), fresnel = 0.04;  // 0.25 m, and 0.5 m for each way back
    EXPECT_NEAR(dark.power.r, inside * (1 - fresnel) / (1 - std::pow(fresnel * 0.25, 2)), 0.01)
        << "the medium begins where the light does";
}

INSTANTIATE_TEST_SUITE_P(Tracers, PhotonsInGlass, testing::Values(Tracer::compute, Tracer::embree),
                         [](const auto& info) {
                             return info.param == Tracer::compute ? "compute" : "embree";
                         });

}  // namespace
}  // namespace ir::test
