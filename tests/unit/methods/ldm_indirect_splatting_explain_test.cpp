// What explains a pixel adds up to it; what is composed is what was splatted.
#include "renderers/methods/ldm-indirect/splatting/found.h"
#include "renderers/passes/ldm/directions.h"
#include "tests/unit/methods/ldm_indirect_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int explain_size = 48, maps = 32;
constexpr glm::vec3 lamp(0.5f, 1, 3);

/// A floor in y = 0, photons from all directions above it, and some directly from the lamp.
class IndirectExplained : public IndirectSplatTest {
  protected:
    IndirectExplained() {
        std::mt19937 random(9);
        std::uniform_real_distribution<float> unit(-1, 1);
        const auto directions = passes::ldm::leopardi_directions(maps);
        run_.parameters = free_parameters();
        run_.parameters.maps.directions = maps;
        for (std::uint32_t i = 0; i < 4000; ++i) {
            FreePhoton photon{.normal = {0, 1, 0}};
            photon.position_ws = {2 * unit(random), 0, 2 * unit(random)};
            photon.axis_u = {0.2f, 0, 0.1f * unit(random)};
            photon.axis_v = {0.1f * unit(random), 0, 0.15f};
            photon.flux = glm::abs(glm::vec3(unit(random), unit(random), unit(random)));
            const auto map = i % maps;
            const auto v = glm::vec3(directions[map].centre);
            const bool against = v.y > 0;  // light has to come from above
            split_points_.push_back(photon.position_ws + (against ? v : -v) * (1 + unit(random)));
            photon.path_length = glm::distance(lamp, split_points_.back()) +
                                 glm::distance(split_points_.back(), photon.position_ws);
            photon.leg = i % 10 == 0 ? 1u << 17 : map | (against ? 0u : 1u << 16);
            run_.photons.push_back(photon);
        }
        run_.wanted = {"indirect.irradiance", "indirect.explain.*"};
    }

    Shot shot() const {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 2);
        auto scene = small.scene();
        scene::Light light;
        light.position = lamp;
        light.intensity = 50;
        scene.lights.push_back(light);
        return {scene, splat_camera({1, 3, 3}, {0, 0, 0}), explain_size, explain_size};
    }

    void expect_sums(glm::ivec2 pixel) {
        const auto irradiance = read("indirect.irradiance");
        const auto expected = rgb(irradiance, pixel.x, pixel.y);
        const auto photons = elements<li::FoundPhoton>("indirect.explain.photons");
        const auto sum = elements<li::PixelSum>("indirect.explain.sum").at(0);
        const auto directions = elements<li::DirectionLight>("indirect.explain.directions");
        ASSERT_EQ(directions.size(), 2u * maps);
        EXPECT_EQ(float(photons.size()), irradiance.at(pixel.x, pixel.y, 3));
        ASSERT_GT(photons.size(), 10u);
        for (std::size_t c = 0; c < 3; ++c) {
            double gathered = 0, by_direction = 0;
            for (const auto& photon : photons) gathered += photon.contribution[c];
            for (const auto& direction : directions) by_direction += direction.contribution[c];
            const double e = expected[int(c)];
            EXPECT_NEAR(gathered, e, 1e-4 * e);
            EXPECT_NEAR(sum.gathered[c], e, 1e-4 * e);
            EXPECT_EQ(sum.pixel[c], expected[int(c)]);
            EXPECT_NEAR(by_direction + sum.direct[c], e, 1e-4 * e);
            EXPECT_GT(sum.direct[c], 0.01 * e);
        }
    }

    IndirectRun run_;
    std::vector<glm::vec3> split_points_;
};

TEST_F(IndirectExplained, PhotonsAndDirectionsSumToThePixel) {
    const auto view = shot();
    run_.inspection = {24, 24, {}};
    for (const auto& way : all_ways) {
        run_.by(way);
        splat(view, run_);
        expect_sums({24, 24});
    }
    for (const auto pixel : {glm::ivec2(20, 30), glm::ivec2(30, 20)}) {  // without a frame
        auto inputs = view.inputs();
        inputs.inspection = {pixel.x, pixel.y, {}};
        graph::FrameOptions options;
        options.wanted = run_.wanted;
        ASSERT_TRUE(graph().explain(method(run_), {}, inputs, options));
        expect_sums(pixel);
    }
}

TEST_F(IndirectExplained, PhotonsAreThoseOfTheBufferByEnergy) {
    run_.inspection = {24, 24, {}};
    splat(shot(), run_);
    const auto photons = elements<li::FoundPhoton>("indirect.explain.photons");
    double last = 1e30;
    for (const auto& photon : photons) {
        const auto& of_buffer = run_.photons.at(photon.photon);
        EXPECT_EQ(photon.centre[0], of_buffer.position_ws.x);
        EXPECT_EQ(photon.flux[1], of_buffer.flux.g);
        EXPECT_EQ(photon.side, of_buffer.leg >> 17 ? 0 : of_buffer.leg >> 16 ? 1 : -1);
        const double total = double(photon.contribution[0]) + photon.contribution[1] + photon.contribution[2];
        EXPECT_LE(total, last);
        last = total;
    }
}

TEST_F(IndirectExplained, PathsBendWhereThePhotonWasSplit) {
    run_.inspection = {24, 24, {}};
    splat(shot(), run_);
    const auto lines = elements<li::PathLine>("indirect.explain.paths");
    const auto point = [](const std::array<float, 3>& p) { return glm::vec3(p[0], p[1], p[2]); };
    ASSERT_GT(lines.size(), 20u);
    for (const auto& line : lines) {
        const bool direct = line.side == 0;
        if (line.leg == 0) {
            EXPECT_LT(glm::distance(point(line.start), lamp), 1e-4f);
        }
        if (!direct) {
            const auto bend = point(line.leg == 0 ? line.end : line.start);
            EXPECT_LT(glm::distance(bend, split_points_.at(line.photon)), 2e-3f);
        }
    }
}

TEST_F(IndirectExplained, NothingWhereNothingIsPicked) {
    for (const auto pixel : {glm::ivec2(-1), glm::ivec2(1000, 3), glm::ivec2(0, 0)}) {
        run_.inspection = {pixel.x, pixel.y, {}};
        splat(shot(), run_);
        EXPECT_TRUE(elements<li::FoundPhoton>("indirect.explain.photons").empty());
        EXPECT_TRUE(elements<li::PixelSum>("indirect.explain.sum").empty());
        EXPECT_TRUE(elements<li::DirectionLight>("indirect.explain.directions").empty());
        EXPECT_TRUE(elements<li::PathLine>("indirect.explain.paths").empty());
    }
}

TEST_F(IndirectExplained, TooSmallBuffersGrow) {
    run_.inspection = {24, 24, {}};
    run_.initial_capacity = 1e-3;
    splat(shot(), run_);
    expect_sums({24, 24});
}

TEST_F(IndirectExplained, RadianceIsMadeOfWhatThePathsSay) {
    auto scene = shot().scene;
    scene.materials[0].base_colour = {0.2f, 0.5f, 0.8f, 1};
    scene.materials[0].metallic = 0.25f;
    scene.materials[0].emission = {0.125f, 0.25f, 0.5f};
    const Shot view(scene, splat_camera({1, 3, 3}, {0, 0, 0}), explain_size, explain_size);
    run_.composed = true;
    run_.wanted = {"radiance", "indirect.*", "direct.radiance"};
    using Paths = Transport::Paths;
    using Materials = Transport::Materials;
    const glm::vec3 emission(0.125f, 0.25f, 0.5f), colour(0.2f, 0.5f, 0.8f);
    for (const auto direct : {li::DirectBy::rasterisation, li::DirectBy::photons})
        for (const auto materials : {Materials::gltf, Materials::lambert})
            for (const auto paths : {Paths::direct, Paths::indirect, Paths::full}) {
                run_.parameters.direct = direct;
                run_.parameters.transport.materials = materials;
                run_.parameters.transport.paths = paths;
                splat(view, run_);
                const bool by_photons = direct == li::DirectBy::photons;
                const auto e = rgb(read("indirect.irradiance"), 24, 24);
                const float rho = materials == Materials::lambert ? 1.0f : 0.75f;
                auto expected = e * rho * colour / float(std::numbers::pi);
                EXPECT_LE(glm::distance(rgb(read("indirect.radiance"), 24, 24),
                                        paths != Paths::direct || by_photons ? expected : glm::vec3(0)),
                          2e-3f * glm::length(e));
                if (paths == Paths::direct && !by_photons) expected = {};
                if (paths != Paths::indirect && !by_photons) {
                    const auto light = rgb(read("direct.radiance"), 24, 24);
                    EXPECT_GT(light.g, 0.1f);
                    expected += light;
                }
                if (paths == Paths::full) expected += emission;
                EXPECT_LT(glm::distance(rgb(read("radiance"), 24, 24), expected),
                          2e-3f * glm::length(expected));
                EXPECT_GT(glm::length(expected), 0.0f);
            }
}

}  // namespace
}  // namespace ir::test
