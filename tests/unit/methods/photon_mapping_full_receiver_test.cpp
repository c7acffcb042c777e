// Surfaces that reflect each photon by itself: the sum of the BRDF over the photons, by closed form.
#include "renderers/passes/scattering/bsdf.h"
#include "shaders/methods/photon-mapping/splatting/added.glsl.h"
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

using Materials = Transport::Materials;

constexpr int full_size = 24;
constexpr float full_kernel_radius = 0.5f;

/// A square z = 0 whose vertex normals lean by `tilt` towards +x.
scene::Scene glossy_square(float tilt, const scene::Material& material) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    auto scene = small.scene();
    scene.meshes[0].normals.assign(4, {std::sin(tilt), 0, std::cos(tilt)});
    scene.materials[0] = material;
    return scene;
}

scene::Material satin(float metallic) {
    scene::Material material;
    material.base_colour = {0.5f, 0.4f, 0.8f, 1};
    material.metallic = metallic, material.roughness = 0.5f;
    return material;
}

/// From both sides and from above: none is near their mean.
std::vector<SomePhoton> from_three_sides() {
    std::vector<SomePhoton> photons;
    for (const auto& [direction, power] : {std::pair{glm::vec3(0.9f, 0.1f, 0.8f), glm::vec3(3, 1, 2)},
                                           {glm::vec3(-1, 0.3f, 1.1f), glm::vec3(1, 2, 1)},
                                           {glm::vec3(0.1f, -0.2f, 1), glm::vec3(0.5f, 0.2f, 1)}})
        photons.push_back(
            {.position_ws = {0.02f, -0.01f, 0}, .power = power, .direction = glm::normalize(direction)});
    return photons;
}

class FullReceiver : public SplatTest {
  protected:
    std::vector<OutputDescription> outputs() const override {
        auto all = pm::splatting_outputs();
        for (const auto& output : pm::filtering_outputs()) all.push_back(output);
        return all;
    }
    SplatRun run_of(const Shot& shot, Materials materials) const {
        SplatRun run{from_three_sides(), with_radius(shot, full_kernel_radius)};
        run.parameters.transport.paths = Transport::Paths::indirect;
        run.parameters.transport.materials = materials;
        run.parameters.receivers.receiver = passes::Receiver::full;
        run.parameters.sum_precision = pm::Precision::single_float;
        run.parameters.temporal = false;
        run.parameters.filter_passes = 0;
        run.wanted = {"radiance", "splat.*", "gbuffer.position"};
        return run;
    }
    glm::vec3 middle(const std::string& key) const { return rgb(read(key), full_size / 2, full_size / 2); }

    FrameReport reflect(const Shot& shot, const SplatRun& run) {
        graph().reset_history();
        graph::Method method;
        method.description.id = "test";
        method.description.outputs = outputs();
        method.setup = [run](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto splat =
                pm::splat_photons(builder, scene, gbuffer, upload(builder, run), run.parameters);
            pm::compose(builder, scene, gbuffer,
                        pm::filter_irradiance(builder, gbuffer, splat, run.parameters), run.parameters);
        };
        return run_shot(shot, method, run);
    }

    /// Σ f E of the photons, each alone, W/(m² sr).
    glm::vec3 sum_of_brdf(const Shot& shot, const scene::Material& material, float tilt,
                          Materials materials) {
        passes::Surface surface;
        surface.geometric_normal_ws = {0, 0, 1};
        surface.shading_normal_ws = {std::sin(tilt), 0, std::cos(tilt)};
        surface.base_colour = glm::vec3(material.base_colour);
        surface.metallic = material.metallic, surface.roughness = material.roughness;
        const passes::Bsdf bsdf(surface, material, materials);
        glm::vec3 sum(0);
        for (const auto& photon : from_three_sides()) {
            auto run = run_of(shot, materials);
            run.photons = {photon};
            run.parameters.receivers.receiver = passes::Receiver::diffuse;
            reflect(shot, run);
            const auto to_viewer = glm::normalize(shot.view.eye_ws - middle("gbuffer.position"));
            sum +=
                bsdf.evaluate(to_viewer, photon.direction) / photon.direction.z * middle("splat.irradiance");
        }
        return sum;
    }
    static Shot seen(float tilt, const scene::Material& material) {
        return {glossy_square(tilt, material), looking({0.5f, 0, 3}, {0, 0, 0}), full_size, full_size};
    }
};

TEST_F(FullReceiver, IsTheSumOfTheBrdfOverThePhotons) {
    for (const auto materials : {Materials::gltf, Materials::metalness_blend})
        for (const float metallic : {0.0f, 0.5f, 1.0f})
            for (const float tilt : {0.0f, 0.2f}) {
                const auto material = satin(metallic);
                const auto shot = seen(tilt, material);
                const auto expected = sum_of_brdf(shot, material, tilt, materials);
                reflect(shot, run_of(shot, materials));
                EXPECT_LT(glm::distance(middle("radiance"), expected), 5e-3f * glm::length(expected))
                    << metallic << " tilted by " << tilt;
            }
}

/// The light of two sides has its highlights where each side is mirrored, and none between.
TEST_F(FullReceiver, TheMeanOfTwoSidesIsAnotherPicture) {
    const auto material = satin(1);
    const auto shot = seen(0, material);
    const auto expected = sum_of_brdf(shot, material, 0, Materials::gltf);
    auto run = run_of(shot, Materials::gltf);
    reflect(shot, run);
    EXPECT_NEAR(middle("radiance").g / expected.g, 1, 5e-3f);
    run.parameters.receivers.receiver = passes::Receiver::mean_direction;
    reflect(shot, run);
    EXPECT_GT(middle("radiance").g / expected.g, 1.5f);
}

/// A smooth metal looks like one with that lobe.
TEST_F(FullReceiver, LobesAreNoNarrowerThanTheLeast) {
    auto smooth = satin(1), least = satin(1);
    smooth.roughness = 0.2f, least.roughness = std::sqrt(pm::least_photon_alpha);
    const auto shot = seen(0, smooth);
    const auto expected = sum_of_brdf(shot, least, 0, Materials::gltf);
    reflect(shot, run_of(shot, Materials::gltf));
    EXPECT_LT(glm::distance(middle("radiance"), expected), 5e-3f * glm::length(expected));
}

/// Flat surfaces look the same where texels are larger, and without the filters' help.
TEST_F(FullReceiver, IsTheSameAtEveryResolution) {
    const auto shot = seen(0, satin(1));
    auto run = run_of(shot, Materials::gltf);
    reflect(shot, run);
    const auto full = middle("radiance");
    for (const auto resolution : {pm::SplatResolution::half, pm::SplatResolution::quarter}) {
        run.parameters.splat_resolution = resolution;
        reflect(shot, run);
        EXPECT_LT(glm::distance(middle("radiance"), full), 0.02f * glm::length(full));
    }
}

TEST_F(FullReceiver, ItsPhotonsExplainThePixel) {
    const auto shot = seen(0.2f, satin(0.5f));
    auto run = run_of(shot, Materials::gltf);
    run.wanted.push_back("splat.explain.*");
    run.inspection = {full_size / 2, full_size / 2, {}};
    reflect(shot, run);
    ASSERT_EQ(explained_sum().photons, 3u);
    EXPECT_EQ(explained_sum().pixel, middle("splat.irradiance"));
    EXPECT_LT(glm::length(explained_sum().difference), 1e-5f * glm::length(explained_sum().pixel));
}

/// But for the half floats of the G-buffer, which the host rounds and a software device cuts off: narrow
/// lobes show how a normal is rounded.
TEST_F(FullReceiver, TheHostReflectsAsTheDeviceDoes) {
    auto scene = scene::load_scene("builtin:cornell");
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        scene.materials[i].metallic = 0.25f * static_cast<float>(i % 4);
        scene.materials[i].roughness = 0.3f + 0.2f * static_cast<float>(i % 3);
    }
    const Shot shot(scene, scene.cameras[0], 60, 44);
    const auto expect_same = [](const Image& device, const Image& host, int channels, const char* name) {
        for (int c = 0; c < channels; ++c) {
            double sum = 0, difference = 0;
            for (int y = 0; y < device.height; ++y)
                for (int x = 0; x < device.width; ++x) {
                    sum += device.at(x, y, c);
                    difference += std::abs(device.at(x, y, c) - host.at(x, y, c));
                }
            EXPECT_GT(sum, 0) << name << c;
            EXPECT_LT(difference / sum, 0.04) << name << c;
        }
    };
    for (const auto materials : {Materials::gltf, Materials::metalness_blend})
        for (const int divisor : {1, 2}) {
            auto run = on_what_is_seen(shot, 4000, 3);
            run.parameters.transport.materials = materials;
            run.parameters.receivers.receiver = passes::Receiver::full;
            run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
            run.parameters.facing_test = divisor == 2;
            const auto device = sums(shot, run), host = sums(shot, run, Processor::host, 2);
            expect_same(device.irradiance, host.irradiance, 4, "irradiance ");
            expect_same(device.direction, host.direction, 2, "reflected ");
        }
}

/// What has no interface is as it is with other receivers.
TEST_F(FullReceiver, DoesNothingToLambertSurfaces) {
    const auto shot = seen(0.2f, satin(0));
    auto run = run_of(shot, Materials::lambert);
    reflect(shot, run);
    const auto full = read("radiance");
    run.parameters.receivers.receiver = passes::Receiver::widened;
    reflect(shot, run);
    EXPECT_EQ(full.pixels, read("radiance").pixels);
}

}  // namespace
}  // namespace ir::test
