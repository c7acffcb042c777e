// Gathering by tiles lights the same texels by the same amount as kernels that are drawn.
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int gathered_size = 64;

class SplattedByTiles : public SplatTest {
  protected:
    Sums by(pm::Splatting splatting, const Shot& shot, SplatRun run) {
        run.parameters.splatting = splatting;
        return sums(shot, run);
    }
    void expect_as_drawn(const Shot& shot, const SplatRun& run, const std::string& name) {
        expect_equal(by(pm::Splatting::drawn, shot, run), by(pm::Splatting::tiles, shot, run), name);
    }
};

TEST_F(SplattedByTiles, AsDrawnAtEveryResolutionAndInEveryView) {
    for (const auto& view : views_of_a_box(gathered_size)) {
        const auto& shot = view.shot;
        auto run = on_what_is_seen(shot, 3000, 4);
        for (const bool flat : {false, true})
            for (const int divisor : {1, 2, 4}) {
                run.parameters.inside_test = flat ? pm::InsideTest::linear_depth : pm::InsideTest::ellipsoid;
                run.parameters.facing_test = divisor == 2;
                run.parameters.edge_probes = divisor == 1;
                run.parameters.splat_resolution = static_cast<pm::SplatResolution>(divisor / 2);
                expect_as_drawn(
                    shot, run, view.name + std::string(flat ? ", flat / " : " / ") + std::to_string(divisor));
            }
    }
}

/// The eye within kernels, which reach behind it, and one behind it altogether.
TEST_F(SplattedByTiles, AsDrawnFromWithinAKernel) {
    const Shot shot(wide_square(), camera_at({0.1f, 0.2f, 0.1f}, {0.4f, 0.3f, 0}), gathered_size,
                    gathered_size);
    expect_as_drawn(shot, around_the_eye(shot), "within");
}

/// A kernel's own tile alone would leave squares.
TEST_F(SplattedByTiles, KernelsLightTheTilesThatTheyReach) {
    const Shot shot(wide_square(), camera_at({0, 0, 5}, {0, 0, 0}), gathered_size, gathered_size);
    const SplatRun run{{{.position_ws = {0.1f, 0.2f, 0}}}, with_radius(shot, 1)};
    const auto irradiance = by(pm::Splatting::tiles, shot, run).irradiance;
    int tiles = 0;
    for (int y = 0; y < gathered_size; y += 16)
        for (int x = 0; x < gathered_size; x += 16) {
            float brightest = 0;
            for (int i = 0; i < 256; ++i)
                brightest = std::max(brightest, irradiance.at(x + i % 16, y + i / 16));
            tiles += brightest > 0;
        }
    EXPECT_GE(tiles, 4);
}

TEST_F(SplattedByTiles, TooSmallListsGrowWithoutLoss) {
    const Shot shot("builtin:cornell", "", gathered_size, gathered_size);
    auto run = on_what_is_seen(shot, 5000, 2);
    run.parameters.splatting = pm::Splatting::tiles;
    run.parameters.kernel_scale = 100;
    run.wanted = {"splat.irradiance", "splat.direction"};
    EXPECT_GT(splat(shot, run).counters.at("splat.bin_entries"), 6000u);
    const auto expected = sums(shot, run);
    run.initial_capacity = 1e-3;
    const auto grown = sums(shot, run);
    EXPECT_EQ(grown.irradiance.pixels, expected.irradiance.pixels);
    EXPECT_EQ(grown.direction.pixels, expected.direction.pixels);
}

/// Of a tile with more photons than one dispatch sums.
TEST_F(SplattedByTiles, LongListsAreSummedToTheirEnd) {
    const Shot shot(wide_square(), camera_at({0, 0, 5}, {0, 0, 0}), 16, 16);
    constexpr int count = 60000;
    SplatRun run{std::vector<SomePhoton>(count, {.position_ws = {0, 0, 0}, .power = glm::vec3(1)}),
                 with_radius(shot, 1)};
    run.parameters.sum_precision = pm::Precision::single_float;
    const auto many = by(pm::Splatting::tiles, shot, run).irradiance;
    run.photons.resize(1);
    const auto one = by(pm::Splatting::tiles, shot, run).irradiance;
    ASSERT_GT(one.at(8, 8), 0);
    EXPECT_NEAR(many.at(8, 8) / one.at(8, 8) / count, 1, 0.01);
}

/// Each sum is rounded, or cut off, once; drawn kernels are at each addition.
TEST_F(SplattedByTiles, HalfFloatsAreRoundedOnce) {
    const Shot shot("builtin:cornell", "", gathered_size, gathered_size);
    auto run = on_what_is_seen(shot, 20000, 6);
    const auto exact = by(pm::Splatting::tiles, shot, run).irradiance;
    run.parameters.sum_precision = pm::Precision::half_float;
    const auto half = by(pm::Splatting::tiles, shot, run).irradiance;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        ASSERT_NEAR(half.pixels[i], exact.pixels[i], 6e-8f + std::abs(exact.pixels[i]) / 1023);
}

}  // namespace
}  // namespace ir::test
