// Kernels on the host's threads light the same texels by the same amount as those that the device draws.
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int host_splat_size = 64;

class SplattedOnHost : public SplatTest {
  protected:
    struct Sums {
        Image irradiance, direction;
    };
    Sums sums(const Shot& shot, const SplatRun& run, Processor processor, int threads = 0) {
        graph().reset_history();
        run_shot(shot, method(run), run, 0, processor, threads);
        return {read("splat.irradiance"), read("splat.direction")};
    }

    /// Texels at the border of a kernel may be on either side of it, by rounding.
    void expect_equal(const Shot& shot, SplatRun run, const std::string& name, int of_texels = 100) {
        run.wanted = {"splat.irradiance", "splat.direction"};
        const auto device = sums(shot, run, Processor::gl), host = sums(shot, run, Processor::host);
        ASSERT_EQ(device.irradiance.width, host.irradiance.width);
        double sum = 0, difference = 0;
        int lit = 0, other = 0;
        for (int y = 0; y < device.irradiance.height; ++y)
            for (int x = 0; x < device.irradiance.width; ++x) {
                const float value = device.irradiance.at(x, y, 1);
                bool equal = true;
                for (int c = 0; c < 4; ++c)
                    equal = equal && std::abs(device.irradiance.at(x, y, c) - host.irradiance.at(x, y, c)) <=
                                         1e-5f * (1e-6f + 3 * value);
                for (int c = 0; c < 2; ++c)
                    equal = equal && std::abs(device.direction.at(x, y, c) - host.direction.at(x, y, c)) <=
                                         1e-5f * (1e-6f + 3 * value);
                lit += value > 0;
                other += !equal;
                sum += value;
                difference += host.irradiance.at(x, y, 1) - value;
            }
        EXPECT_GT(lit, 20) << name;
        EXPECT_LE(other, 2 + lit / of_texels) << name << ", of " << lit;
        EXPECT_NEAR(difference / sum, 0, 2e-3) << name;
    }
};

TEST_F(SplattedOnHost, AsOnTheDeviceAtEveryResolutionAndInEveryView) {
    auto box = scene::load_scene("builtin:cornell");
    auto close = box.cameras[0];
    close.eye = scene::bounds_of(box, 0).centre();
    close.target = close.eye + glm::vec3(0.3f, 0.2f, -1);
    auto parallel = box.cameras[0];
    parallel.orthographic = true;
    parallel.height = 0.5f * scene::bounds_of(box, 0).radius();
    const char* names[] = {"perspective", "close", "parallel"};
    int view = 0;
    for (const auto& camera : {box.cameras[0], close, parallel}) {
        const Shot shot(box, camera, host_splat_size, host_splat_size - 3);
        run_gbuffer(shot);
        SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 3000, 4), {}};
        run.parameters.sum_precision = pm::Precision::single_float;
        run.parameters.kernel_scale = 6;
        run.parameters.normal_axis = 0.5f;
        for (const bool facing : {false, true})
            for (const int divisor : {1, 2, 4}) {
                run.parameters.facing_test = facing;
                run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
                expect_equal(shot, run, std::string(names[view]) + " / " + std::to_string(divisor));
            }
        ++view;
    }
}

/// The eye within kernels, which reach behind it.
TEST_F(SplattedOnHost, AsOnTheDeviceFromWithinAKernel) {
    const Shot shot(wide_square(), camera_at({0.1f, 0.2f, 0.1f}, {0.4f, 0.3f, 0}), host_splat_size,
                    host_splat_size);
    SplatRun run{{{.position_ws = {0, 0, 0}, .power = glm::vec3(2)},
                  {.position_ws = {0, 3, 0}, .power = glm::vec3(1)},
                  {.position_ws = {-0.5f, -9, 0}, .power = glm::vec3(1)}},
                 with_radius(shot, 1)};
    run.parameters.sum_precision = pm::Precision::single_float;
    expect_equal(shot, run, "within");
}

/// A probe that rounds to another texel changes all that its kernel covers.
TEST_F(SplattedOnHost, ProbesFindTheSameEdges) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 1000, 7), {}};
    run.parameters.sum_precision = pm::Precision::single_float;
    run.parameters.kernel_scale = 6;
    run.parameters.edge_probes = true;
    expect_equal(shot, run, "probes", 20);
}

TEST_F(SplattedOnHost, SameBytesWhateverTheThreads) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 20000, 5), {}};
    run.parameters.sum_precision = pm::Precision::single_float;
    const auto first = sums(shot, run, Processor::host, 1), second = sums(shot, run, Processor::host, 4);
    EXPECT_EQ(first.irradiance.pixels, second.irradiance.pixels);
    EXPECT_EQ(first.direction.pixels, second.direction.pixels);
}

TEST_F(SplattedOnHost, HalfFloatsAreRoundedOnce) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 20000, 6), {}};
    run.parameters.kernel_scale = 4;
    const auto half = sums(shot, run, Processor::host).irradiance;
    run.parameters.sum_precision = pm::Precision::single_float;
    const auto exact = sums(shot, run, Processor::host).irradiance;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        ASSERT_NEAR(half.pixels[i], exact.pixels[i], 6e-8f + std::abs(exact.pixels[i]) / 2047);
}

}  // namespace
}  // namespace ir::test
