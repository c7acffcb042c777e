#include <cmath>

#include "tests/unit/methods/photon_mapping_tracing_fixture.h"
#include "tests/unit/passes/bsdf_fixture.h"

namespace ir::test {
namespace {

using methods::photon_mapping::Tracer;

constexpr int paths = 20000;
constexpr double power_unit = 2;  ///< W, of the fixture

/// Closed and white inside: what is stored on a bounce is Φ ρ^b.
Shot furnace(float albedo) {
    auto scene = flat_shaded(scene::load_scene("builtin:furnace?emission=0"));
    scene.materials[0].base_colour = glm::vec4(glm::vec3(albedo), 1);
    return {scene, scene.cameras[0], 32, 32};
}

struct FluxCase {
    Roulette roulette;
    Tracer tracer;
    float albedo;
};

class PhotonFlux : public TracingTest, public testing::WithParamInterface<FluxCase> {};

TEST_P(PhotonFlux, OfEachBounceIsThatOfTheBounceBeforeTimesTheAlbedo) {
    const auto& given = GetParam();
    const auto shot = furnace(given.albedo);
    auto parameters = plain(4);
    parameters.roulette = given.roulette;
    parameters.tracer = given.tracer;
    FirstHit material;
    material.base_colour = glm::vec3(given.albedo);
    material.power = glm::vec3(1 / given.albedo);  // as the roulette at the sample points leaves it
    const auto outcome = trace(shot, random_points(shot.world, paths, material), parameters);
    ASSERT_EQ(outcome.tally.size(), 5u);
    const double emitted = power_unit * paths;
    EXPECT_NEAR(outcome.tally[0].power.r, emitted / given.albedo, 2e-3 * emitted);
    for (int bounce = 1; bounce <= 4; ++bounce) {
        const auto& row = outcome.tally[static_cast<std::size_t>(bounce)];
        // n = 20,000 trials that survive with probability q, alpha = 1e-4 over 48 comparisons (z = 4.9); and
        // half of RGB9E5's 256 steps
        const double q = std::pow(given.albedo, bounce - 1);
        const double tolerance = 4.9 * power_unit * std::sqrt(paths * q * (1 - q)) + 0.002 * emitted * q;
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(row.power[channel], emitted * q, tolerance) << "bounce " << bounce;
        if (given.albedo < 1) {
            // the mutant: survivors whose power the roulette has not divided by its probability
            EXPECT_GT(std::abs(row.power.r - emitted * q * q * given.albedo), tolerance);
        }
        EXPECT_EQ(row.missed, 0u);
        EXPECT_EQ(row.culled, 0u);
        EXPECT_EQ(row.cut, 0u);
        EXPECT_EQ(row.rays, outcome.tally[static_cast<std::size_t>(bounce) - 1].rays -
                                outcome.tally[static_cast<std::size_t>(bounce) - 1].absorbed);
    }
    EXPECT_EQ(outcome.report.counters.at("photons.count"), outcome.stored());
}

// 153/255: what sample points can hold exactly
INSTANTIATE_TEST_SUITE_P(Furnace, PhotonFlux,
                         testing::Values(FluxCase{Roulette::multichannel, Tracer::compute, 0.6f},
                                         FluxCase{Roulette::multichannel, Tracer::embree, 0.6f},
                                         FluxCase{Roulette::per_channel, Tracer::compute, 0.6f},
                                         FluxCase{Roulette::per_channel, Tracer::embree, 0.6f},
                                         FluxCase{Roulette::multichannel, Tracer::compute, 1.0f},
                                         FluxCase{Roulette::per_channel, Tracer::embree, 1.0f}));

class PhotonRoulette : public TracingTest {};

TEST_F(PhotonRoulette, KeepsTheMeanOfEveryChannelInBothForms) {
    const glm::vec3 albedo(0.8f, 0.4f, 0.2f);
    auto scene = furnace(1).scene;
    scene.materials[0].base_colour = glm::vec4(albedo, 1);
    const Shot shot(scene, scene.cameras[0], 32, 32);
    FirstHit material;
    material.base_colour = albedo;
    const auto points = random_points(shot.world, paths, material);
    double stored[2] = {};
    for (const auto roulette : {Roulette::multichannel, Roulette::per_channel}) {
        auto parameters = plain(3);
        parameters.roulette = roulette;
        const auto outcome = trace(shot, points, parameters);
        for (int bounce = 1; bounce <= 3; ++bounce)
            for (int channel = 0; channel < 3; ++channel) {
                // alpha = 1e-4 over 18 comparisons, z = 4.6. A photon carries at most P = 1 in either form
                // and the mean q, so that its variance is at most q (1 - q).
                const double q = std::pow(albedo[channel], bounce);
                const double found =
                    outcome.tally[static_cast<std::size_t>(bounce)].power[channel] / power_unit / paths;
                EXPECT_NEAR(found, q, 4.6 * std::sqrt(q * (1 - q) / paths) + 0.004 * q)
                    << "bounce " << bounce << " channel " << channel;
            }
        stored[roulette == Roulette::per_channel] = outcome.stored();
    }
    EXPECT_GT(stored[1], stored[0]) << "channels of their own die less often together";
}

/// One reflection at α = (180/255)², F = 1, cosθ = 0.2.
class GlossyPhotons : public TracingTest {
  protected:
    static constexpr float roughness = 180 / 255.0f;

    static double albedo(Materials model, float of_roughness) {
        Patch patch(model);
        patch.surface.metallic = 1;
        patch.surface.roughness = of_roughness;
        patch.surface.base_colour = glm::vec3(1);
        return directional_albedo(patch, patch.direction(0.2f));
    }

    struct Mean {
        double value, error;
    };
    Mean reflected(Materials model, MicrofacetSampling sampling) {
        const auto shot = furnace(1);
        FirstHit hit;
        hit.position_ws = {0, -0.9f, 0};
        hit.normal_ws = {0, 1, 0};
        hit.roughness = roughness;
        hit.metallic = 1;
        hit.arrived_from = {-std::sqrt(1 - 0.04f), 0.2f, 0};
        std::vector<SamplePoint> points;
        for (int i = 0; i < paths; ++i) points.push_back(sample_point(hit, static_cast<std::uint32_t>(i)));
        auto parameters = plain(1);
        parameters.transport.materials = model;
        parameters.microfacet_sampling = sampling;
        const auto outcome = trace(shot, points, parameters);
        double squares = 0;
        for (const auto& photon : outcome.photons) {
            const double power = methods::photon_mapping::unpacked_power(photon.power).r;
            squares += power * power / paths;
        }
        const double mean = outcome.tally[1].power.r / power_unit / paths;
        return {mean, std::sqrt((squares - mean * mean) / paths)};
    }
};

TEST_F(GlossyPhotons, KeepTheDirectionalAlbedo) {
    // the maskings of both directions multiplied, as published, and correlated by height
    EXPECT_NEAR(albedo(Materials::metalness_blend, std::sqrt(0.5f)), 0.739, 1e-3);
    EXPECT_NEAR(albedo(Materials::gltf, std::sqrt(0.5f)), 0.790, 1e-3);
    for (const auto model : {Materials::gltf, Materials::metalness_blend}) {
        const double expected = albedo(model, roughness);
        for (const auto sampling : {MicrofacetSampling::visible_normals, MicrofacetSampling::ggx}) {
            // n = 20,000, alpha = 1e-4 over 4 comparisons: z = 4.2; 1e-3 of quadrature and RGB9E5
            const auto found = reflected(model, sampling);
            EXPECT_NEAR(found.value, expected, 4.2 * found.error + 1e-3);
        }
        const auto printed = reflected(model, MicrofacetSampling::ggx_printed);
        EXPECT_GT(std::abs(printed.value - expected), 4.2 * printed.error + 1e-3)
            << "the printed survival must be rejected";
    }
}

}  // namespace
}  // namespace ir::test
