// A photon's power arrives, whatever the resolution, the inside test, the precision and the view.
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "tests/unit/methods/photon_mapping_splatting_fixture.h"

namespace ir::test {
namespace {

using pm::InsideTest;
using pm::Precision;
using pm::SplatResolution;

constexpr int splats_size = 128;

/// Photons around the origin of the plane z = 0, from all directions above.
std::vector<SomePhoton> scattered(int count, float extent, unsigned seed = 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-extent, extent);
    std::vector<SomePhoton> photons;
    for (int i = 0; i < count; ++i) {
        auto direction = random_direction(random);
        direction.z = std::abs(direction.z) + 0.1f;
        photons.push_back({.position_ws = {place(random), place(random), 0},
                           .power = {1, 0.5f, 0.25f},
                           .direction = glm::normalize(direction)});
    }
    return photons;
}

struct View {
    const char* name;
    glm::vec3 eye;
    bool orthographic = false;
};
const View views[] = {{"facing", {0, 0, 5}},
                      {"oblique", {4.2f, 0.6f, 2.6f}},
                      {"parallel", {0.5f, 0.3f, 5}, true},
                      {"oblique, parallel", {-3, 2, 3}, true}};

class SplattedFlux : public SplatTest,
                     public testing::WithParamInterface<std::tuple<SplatResolution, InsideTest, Precision>> {
};

std::string flux_name(const testing::TestParamInfo<SplattedFlux::ParamType>& info) {
    const char* resolutions[] = {"full", "half", "quarter"};
    const auto [resolution, test, precision] = info.param;
    return std::string(resolutions[static_cast<int>(resolution)]) +
           (test == InsideTest::ellipsoid ? "_ellipsoid" : "_linear") +
           (precision == Precision::half_float ? "_16" : "_32");
}
INSTANTIATE_TEST_SUITE_P(, SplattedFlux,
                         testing::Combine(testing::Values(SplatResolution::full, SplatResolution::half,
                                                          SplatResolution::quarter),
                                          testing::Values(InsideTest::ellipsoid, InsideTest::linear_depth),
                                          testing::Values(Precision::half_float, Precision::single_float)),
                         flux_name);

/// 64 kernels of 12 pixels' radius: what their borders gain and lose at the texels' grid averages to less
/// than the tolerance.
TEST_P(SplattedFlux, IsThePhotonsPower) {
    const auto [resolution, test, precision] = GetParam();
    for (const auto& view : views) {
        const Shot shot(wide_square(), camera_at(view.eye, {0, 0, 0}, view.orthographic), splats_size,
                        splats_size);
        SplatRun run{scattered(256, 0.6f), with_radius(shot, 0.4f)};
        run.parameters.splat_resolution = resolution;
        run.parameters.inside_test = test;
        run.parameters.sum_precision = precision;
        run.wanted = {"splat.irradiance", "splat.depth"};
        splat(shot, run);
        const auto sum = flux(shot, {0, 0, 1}, pm::divisor_of(resolution));
        EXPECT_NEAR(sum.r / 256, 1, precision == Precision::half_float ? 0.025 : 0.01) << view.name;
        EXPECT_NEAR(sum.g / sum.r, 0.5, 2e-3) << view.name;
        EXPECT_NEAR(sum.b / sum.r, 0.25, 2e-3) << view.name;
    }
}

using Splatting = SplatTest;

/// The mutant of the flux: vertices on the ellipsoid, as described.
TEST_F(Splatting, AnIcosahedronWithinTheKernelLosesAQuarterOfTheFlux) {
    const Shot shot(wide_square(), camera_at({0, 0, 5}, {0, 0, 0}), splats_size, splats_size);
    const SplatRun run{scattered(256, 0.6f), with_radius(shot, 0.4f)};
    for (const bool mutant : {false, true}) {
        PassTest::run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto photons = pm::stored_photons(builder, upload(builder, run));
            const auto kernels =
                pm::declare_kernels(builder, photons, pm::count_tiles(builder, photons, run.parameters),
                                    pm::splat_surfaces(builder, scene, gbuffer, 1), run.parameters);
            const auto irradiance = builder.output("splat.irradiance", {.format = gl::Format::rgba32f});
            const auto direction = builder.output("splat.direction", {.format = gl::Format::rgba32f});
            pm::KernelPass pass{"draw", "draw.command", {irradiance, direction}, {}};
            if (mutant) pass.defines["ICOSAHEDRON_SCALE"] = "1.0";
            pm::draw_kernels(builder, kernels, pass);
        });
        const auto sum = flux(shot, {0, 0, 1}, 1);
        if (mutant)
            EXPECT_NEAR(sum.r / 256, 0.755, 0.03);
        else
            EXPECT_NEAR(sum.r / 256, 1, 0.01);
    }
}

/// Kernels hang over the edges of a square of 2 m. For each metre of an edge they lose the light of half the
/// mean distance from a diameter, 2 r / (3 π): 11 % of all with a radius of 0.25 m.
TEST_F(Splatting, ProbesKeepTheLightThatHangsOverEdges) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 1);
    const Shot shot(small.scene(), camera_at({0.3f, 0.2f, 5}, {0, 0, 0}), splats_size, splats_size);
    double light[2];
    for (const bool probes : {false, true}) {
        SplatRun run{scattered(2000, 1), with_radius(shot, 0.25f)};
        run.parameters.max_stretch = 1;
        run.parameters.sum_precision = Precision::single_float;
        run.parameters.edge_probes = probes;
        run.wanted = {"splat.irradiance", "splat.depth"};
        splat(shot, run);
        light[probes] = flux(shot, {0, 0, 1}, 1).r / 2000;
    }
    EXPECT_NEAR(light[false], 1 - 4 * 0.25 / (3 * std::numbers::pi), 0.025);
    EXPECT_NEAR(light[true], 1, 0.02);
}

/// A thing so small that all probes miss it.
TEST_F(Splatting, ProbesMakeAPhotonEightThirdsAsBrightAtMost) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 0, 1}, 0.05f);
    const Shot shot(small.scene(), camera_at({0, 0, 1}, {0, 0, 0}), splats_size, splats_size);
    double light[2];
    for (const bool probes : {false, true}) {
        SplatRun run{{{.position_ws = {0, 0, 0}}}, with_radius(shot, 0.5f)};
        run.parameters.sum_precision = Precision::single_float;
        run.parameters.edge_probes = probes;
        run.wanted = {"splat.irradiance", "splat.depth"};
        splat(shot, run);
        light[probes] = flux(shot, {0, 0, 1}, 1).r;
    }
    EXPECT_NEAR(light[true] / light[false], 8.0 / 3, 1e-3);
}

/// 2,000 photons whose kernels would have a radius of 0.2 texels. A disc of √½ texels covers 1.57 middles in
/// the mean, 1 to 2 of them: the flux has a relative standard deviation of 0.7 %; alpha = 1e-4.
TEST_F(Splatting, KernelsBelowTexelsKeepTheFluxWithLessNoise) {
    const Shot shot(wide_square(), camera_at({0, 0, 5}, {0, 0, 0}, true), splats_size, splats_size);
    const float texel = 4.0f / splats_size;
    auto photons = scattered(2000, 1.5f);
    for (auto& photon : photons) photon.direction = {0, 0, 1};
    double squares[2] = {0, 0};
    for (const bool published : {false, true}) {
        SplatRun run{photons, with_radius(shot, 0.2f * texel)};
        run.parameters.sum_precision = Precision::single_float;
        if (!published) run.parameters.min_radius_texels = 0.7072f;
        run.wanted = {"splat.irradiance", "splat.depth"};
        splat(shot, run);
        EXPECT_NEAR(flux(shot, {0, 0, 1}, 1).r / 2000, 1, published ? 3.89 * 0.06 : 3.89 * 0.007);
        const auto irradiance = read("splat.irradiance");
        for (int y = 20; y < 108; ++y)
            for (int x = 20; x < 108; ++x)
                squares[published] += std::pow(irradiance.at(x, y) - 2000 / 9.0, 2);
    }
    EXPECT_GT(squares[1], 4 * squares[0]) << "measured: 3.4 times the noise";
}

}  // namespace
}  // namespace ir::test
