// Kernels on the host's threads light the same texels by the same amount as those that the device draws.
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int host_splat_size = 64;

class SplattedOnHost : public SplatTest {
  protected:
    void expect_as_on_device(const Shot& shot, const SplatRun& run, const std::string& name,
                             int of_texels = 100) {
        expect_equal(sums(shot, run, Processor::gl), sums(shot, run, Processor::host), name, of_texels);
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
        SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 3000, 4),
                     plain_kernels()};
        run.parameters.sum_precision = pm::Precision::single_float;
        run.parameters.kernel_scale = 6;
        run.parameters.normal_axis = 0.5f;
        for (const bool facing : {false, true})
            for (const int divisor : {1, 2, 4}) {
                run.parameters.facing_test = facing;
                run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
                expect_as_on_device(shot, run, std::string(names[view]) + " / " + std::to_string(divisor));
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
    expect_as_on_device(shot, run, "within");
}

/// A probe that rounds to another texel changes all that its kernel covers.
TEST_F(SplattedOnHost, ProbesFindTheSameEdges) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 1000, 7),
                 plain_kernels()};
    run.parameters.sum_precision = pm::Precision::single_float;
    run.parameters.kernel_scale = 6;
    run.parameters.edge_probes = true;
    expect_as_on_device(shot, run, "probes", 20);
}

TEST_F(SplattedOnHost, SameBytesWhateverTheThreads) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 20000, 5),
                 plain_kernels()};
    run.parameters.sum_precision = pm::Precision::single_float;
    const auto first = sums(shot, run, Processor::host, 1), second = sums(shot, run, Processor::host, 4);
    EXPECT_EQ(first.irradiance.pixels, second.irradiance.pixels);
    EXPECT_EQ(first.direction.pixels, second.direction.pixels);
}

TEST_F(SplattedOnHost, HalfFloatsAreRoundedOnce) {
    const Shot shot("builtin:cornell", "", host_splat_size, host_splat_size);
    run_gbuffer(shot);
    SplatRun run{on_surfaces(read("gbuffer.position"), read("gbuffer.geometric_normal"), 20000, 6),
                 plain_kernels()};
    run.parameters.kernel_scale = 4;
    const auto half = sums(shot, run, Processor::host).irradiance;
    run.parameters.sum_precision = pm::Precision::single_float;
    const auto exact = sums(shot, run, Processor::host).irradiance;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        ASSERT_NEAR(half.pixels[i], exact.pixels[i], 6e-8f + std::abs(exact.pixels[i]) / 2047);
}

}  // namespace
}  // namespace ir::test
