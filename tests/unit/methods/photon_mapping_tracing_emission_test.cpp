#include <cmath>
#include <glm/gtc/constants.hpp>

#include "tests/unit/methods/photon_mapping_tracing_fixture.h"

namespace ir::test {
namespace {

using methods::photon_mapping::Emission;

/// Emission and tracing together, in a closed sphere with a lamp in its middle.
class PhotonsOfALamp : public TracingTest {
  protected:
    std::vector<OutputDescription> outputs() const override {
        return joined({methods::photon_mapping::emission_outputs(), TracingTest::outputs()});
    }
    static constexpr float intensity = 3;  // W/sr

    static Shot lit_furnace(float albedo) {
        auto scene = flat_shaded(scene::load_scene("builtin:furnace?emission=0"));
        scene.materials[0].base_colour = glm::vec4(glm::vec3(albedo), 1);
        scene::Light light;
        light.intensity = intensity;
        scene.lights = {light};
        return {scene, scene.cameras[0], 32, 32};
    }
    std::vector<TallyRow> flux(const Shot& shot, const Parameters& parameters) {
        run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto samples =
                methods::photon_mapping::emit(builder, scene, passes::gbuffer(builder, scene), parameters);
            methods::photon_mapping::trace_photons(builder, scene, samples, parameters);
        });
        return elements<TallyRow>("photons.tally");
    }
};

TEST_F(PhotonsOfALamp, StoreItsFluxTimesTheAlbedoOfEveryBounce) {
    constexpr float albedo = 0.6f;
    const auto shot = lit_furnace(albedo);
    auto parameters = plain(3);
    parameters.photons = 20000;
    parameters.rsm_resolution = methods::photon_mapping::Resolution::r64;
    const double emitted = 4 * glm::pi<double>() * intensity;
    for (const auto emission : {Emission::importance, Emission::uniform})
        for (const auto roulette : {Roulette::multichannel, Roulette::per_channel}) {
            parameters.emission = emission;
            parameters.roulette = roulette;
            const auto tally = flux(shot, parameters);
            for (int bounce = 0; bounce <= 3; ++bounce) {
                // n = 20,000 photons, alpha = 1e-4 over 16 comparisons: z = 4.5. Photons of uniform emission
                // differ in power by up to 3 : 1 (texels of a cube's face); 0.5 % for packing and the RSM
                const double q = std::pow(albedo, bounce);
                const double alive = bounce == 0 ? albedo : std::pow(albedo, bounce);
                const double tolerance =
                    4.5 * std::sqrt((1.3 - alive) / (alive * parameters.photons)) * emitted * q;
                EXPECT_NEAR(tally[static_cast<std::size_t>(bounce)].power.g, emitted * q,
                            tolerance + 0.005 * emitted * q)
                    << "bounce " << bounce;
            }
        }
}

}  // namespace
}  // namespace ir::test
