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
    for (const auto& view : views_of_a_box(host_splat_size)) {
        const auto& shot = view.shot;
        auto run = on_what_is_seen(shot, 3000, 4);
        for (const bool facing : {false, true})
            for (const int divisor : {1, 2, 4}) {
                run.parameters.facing_test = facing;
                run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
                expect_as_on_device(shot, run, view.name + " / " + std::to_string(divisor));
            }
    }
}

/// The eye within kernels, which reach behind it.
TEST_F(SplattedOnHost, AsOnTheDeviceFromWithinAKernel) {
    const Shot shot(wide_square(), camera_at({0.1f, 0.2f, 0.1f}, {0.4f, 0.3f, 0}), host_splat_size,
                    host_splat_size);
    expect_as_on_device(shot, around_the_eye(shot), "within");
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
