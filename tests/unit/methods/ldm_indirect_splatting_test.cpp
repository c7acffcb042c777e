// What splatting adds is what eqs. 4 to 7 say, whichever way it is done.
#include "tests/unit/methods/ldm_indirect_splatting_fixture.h"

namespace ir::test {
namespace {

constexpr int splatting_size = 128;

class IndirectSplatting : public IndirectSplatTest {
  protected:
    /// The picture against the sum of printed_contribution over all photons. Largest error, relative to the
    /// picture's largest value.
    double error_of(const IndirectRun& run, bool with_pi = true) {
        const auto irradiance = read("indirect.irradiance"), position = read("gbuffer.position"),
                   normal = read("gbuffer.geometric_normal");
        double error = 0, largest = 0;
        for (int y = 0; y < irradiance.height; ++y)
            for (int x = 0; x < irradiance.width; ++x) {
                glm::dvec3 sum(0);
                const auto n = rgb(normal, x, y);
                for (const auto& photon : run.photons)
                    if (n != glm::vec3(0))
                        sum += turned(photon, n) *
                               printed_contribution(photon, run.parameters, rgb(position, x, y), with_pi);
                const auto difference = glm::abs(sum - glm::dvec3(rgb(irradiance, x, y)));
                error = std::max({error, difference.r, difference.g, difference.b});
                largest = std::max({largest, sum.r, sum.g, sum.b});
            }
        return error / largest;
    }

    static std::vector<FreePhoton> many(int count, float spread) {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> unit(-1, 1);
        std::vector<FreePhoton> photons;
        for (int i = 0; i < count; ++i) {
            FreePhoton photon;
            photon.position_ws = spread * glm::vec3(unit(random), unit(random), 0);
            photon.axis_u = 0.3f * glm::vec3(unit(random), unit(random), 0);
            photon.axis_v = 0.3f * glm::vec3(unit(random), unit(random), 0);
            photon.flux = glm::abs(glm::vec3(unit(random), unit(random), unit(random)));
            photons.push_back(photon);
        }
        return photons;
    }
};

const FreePhoton shapes[] = {
    {},
    {.axis_u = {0.6f, 0.2f, 0}, .axis_v = {-0.1f, 0.2f, 0}},                                  // anisotropic
    {.position_ws = {0.2f, -0.1f, 0}, .axis_u = {0.5f, 0.2f, 0}, .axis_v = {0.2f, 0.4f, 0}},  // sheared
};

TEST_F(IndirectSplatting, OnePhotonOnAPlaneIsItsFlux) {
    for (const bool orthographic : {false, true})
        for (const auto eye : {glm::vec3(0, 0, 4), glm::vec3(2.2f, -2.2f, 2.4f)}) {
            const Shot shot(lit_square(), splat_camera(eye, {0, 0, 0}, orthographic), splatting_size,
                            splatting_size);
            for (const auto& way : all_ways)
                for (const float s : {0.8f, 1.0f, 1.7f}) {
                    for (const auto& shape : shapes) {
                        IndirectRun run{.photons = {shape}, .parameters = free_parameters()};
                        run.by(way);
                        run.parameters.splat_size = s;
                        splat(shot, run);
                        const auto sum = flux(shot, {0, 0, 1});
                        for (int c = 0; c < 3; ++c)
                            EXPECT_NEAR(sum[c], shape.flux[c], 1e-3 * shape.flux[c])
                                << way.name << " s " << s << " eye " << eye.x << " " << orthographic;
                    }
                }
        }
}

TEST_F(IndirectSplatting, PixelsAreThePrintedEquationsAndNotThoseWithoutPi) {
    for (const auto& way : all_ways)
        for (const float bias : {0.5f, 1.0f, 3.0f}) {
            SmallWorld small;
            small.square({0, 0, 0}, {0, 0, 1}, 20);
            small.square({0, 0, 0.12f}, glm::normalize(glm::vec3(0.3f, 0.1f, 1)), 0.3f);
            auto scene = small.scene();
            scene.lights = lit_square().lights;
            const Shot shot(scene, splat_camera({2, -3, 2}, {0, 0, 0}), splatting_size, splatting_size);
            IndirectRun run{.photons = {shapes[0], shapes[1]}, .parameters = free_parameters()};
            run.by(way);
            run.parameters.topological_bias = bias;
            splat(shot, run);
            EXPECT_LT(error_of(run), 1e-4) << way.name << " a' " << bias;
            EXPECT_GT(error_of(run, false), 0.5);
        }
}

TEST_F(IndirectSplatting, FootprintsAcrossTheNearPlaneAndBehindTheEye) {
    const Shot shot(lit_square(), splat_camera({0, -0.5f, 0.4f}, {0, 3, 0}), splatting_size, splatting_size);
    for (const auto& way : all_ways) {
        IndirectRun run{.parameters = free_parameters()};
        run.by(way);
        run.photons = {{.position_ws = {0, 0.2f, 0}, .axis_u = {1.5f, 0, 0}, .axis_v = {0, 2, 0}},
                       {.position_ws = {0.3f, -2, 0}, .axis_u = {2.5f, 1, 0}, .axis_v = {-1, 3, 0}},
                       {.position_ws = {1, -0.3f, 0}, .axis_u = {0.4f, 0, 0}, .axis_v = {0, 0.6f, 0}},
                       {.position_ws = {0, -9, 0}}};
        splat(shot, run);
        EXPECT_LT(error_of(run), 1e-4) << way.name;
    }
}

TEST_F(IndirectSplatting, WaysAgreeAndOrdersAreFixed) {
    const Shot shot(lit_square(), splat_camera({1, -2, 3}, {0, 0, 0}), 100, 75);
    IndirectRun run{.photons = many(3000, 3), .parameters = free_parameters(), .capacity = 5000};
    std::vector<Image> pictures;
    for (const auto& way : all_ways) {
        run.by(way);
        splat(shot, run);
        pictures.push_back(read("indirect.irradiance"));
        if (way.splatting == li::Splatting::image_atomics) continue;
        splat(shot, run);
        EXPECT_EQ(read("indirect.irradiance").pixels, pictures.back().pixels);
    }
    double lit = 0;
    const float rounding = device().software() ? 1e-4f : 1e-3f;
    for (std::size_t way : {1u, 2u, 3u})
        for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
            const float expected = pictures[0].pixels[i];
            ASSERT_NEAR(pictures[way].pixels[i], expected, rounding * expected + 1e-6f) << way << " at " << i;
            lit += expected > 0;
        }
    EXPECT_GT(lit, 0.5 * 3 * double(pictures[0].pixels.size()));
}

TEST_F(IndirectSplatting, DirectionsAreSummedByTheirLight) {
    const Shot shot(lit_square(), splat_camera({1, -2, 3}, {0, 0, 0}), 64, 64);
    for (const auto& way : all_ways) {
        IndirectRun run{.photons = {{.position_ws = {-1, 0, 0}}}, .parameters = free_parameters()};
        run.photons.push_back({.position_ws = {1, 0, 0}, .flux = {3, 2, 2}});
        run.by(way);
        splat(shot, run);
        const auto irradiance = read("indirect.irradiance"), direction = read("indirect.direction"),
                   position = read("gbuffer.position");
        int lit = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const auto e = rgb(irradiance, x, y);
                const float side = rgb(position, x, y).x < 0 ? -1 : 1;
                const auto towards = glm::normalize(glm::vec3(-side, 0, 30));
                EXPECT_LE(glm::distance(rgb(direction, x, y), (e.r + e.g + e.b) * towards),
                          1e-4f * (e.r + e.g + e.b))
                    << way.name;
                lit += e.r > 0;
            }
        EXPECT_GT(lit, 150) << way.name;
    }
}

// Many rounds of photons and squares of tiles, some of which are beside the picture.
TEST_F(IndirectSplatting, TheHostGivesThePictureOfTheDeviceWhateverTheThreads) {
    for (const auto& [width, height] : {std::pair{131, 77}, {7, 3}, {1, 1}})
        for (const bool orthographic : {false, true}) {
            const Shot shot(lit_square(2), splat_camera({1, -2, 3}, {0, 0, 0}, orthographic), width, height);
            IndirectRun run{.photons = many(20001, 3), .parameters = free_parameters()};
            run.by(all_ways[1]);
            const auto report = splat(shot, run);
            const auto device = read("indirect.irradiance");
            run.by(all_ways[2]);
            std::vector<Image> pictures;
            for (const int threads : {1, 2, 5}) {
                run.threads = threads;
                const auto counters = splat(shot, run).counters;
                for (const auto* key : {"splat.short", "splat.long", "splat.degenerate", "splat.not_finite"})
                    EXPECT_NEAR(double(counters.at(key)), double(report.counters.at(key)), 2) << key;
                pictures.push_back(read("indirect.irradiance"));
            }
            EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
            EXPECT_EQ(pictures[0].pixels, pictures[2].pixels);
            double lit = 0, different = 0;
            for (std::size_t i = 0; i < device.pixels.size(); ++i) {
                // Whether a pixel on the rim of a footprint counts is rounding; its light is not.
                const float allowed = i % 4 == 3 ? 2 : 2e-4f * device.pixels[i] + 1e-4f;
                ASSERT_NEAR(pictures[0].pixels[i], device.pixels[i], allowed) << "at " << i;
                lit += device.pixels[i] > 0;
                different += pictures[0].pixels[i] != device.pixels[i];
            }
            std::printf("%dx%d: %.0f values, %.0f differ\n", width, height, lit, different);
            EXPECT_GT(lit, 0);
        }
}

TEST_F(IndirectSplatting, SeventyThousandOverlapping) {
    expect_overlapping(70000, 16);  // more than a dispatch sums of a list
}

TEST_F(IndirectSplatting, ClampsAreCountedAndKeepTheFlux) {
    const float nan = std::nanf("");
    const Shot shot(lit_square(), splat_camera({0, 0, 5}, {0, 0, 0}), splatting_size, splatting_size);
    const struct {
        FreePhoton photon;
        std::map<std::string, std::uint64_t> counts;
    } cases[] = {
        {{.axis_u = {1e-5f, 0, 0}}, {{"splat.short", 1}}},
        {{.axis_u = {1, 1, 0}, .axis_v = {2, 2, 0}},
         {{"splat.short", 1}, {"splat.long", 1}, {"splat.degenerate", 1}}},
        {{.axis_u = {nan, 0, 0}}, {{"splat.short", 1}, {"splat.degenerate", 1}}},
        {{.axis_u = {100, 0, 0}}, {{"splat.long", 1}}},
        {{.axis_u = {INFINITY, 0, 0}, .axis_v = {0, 0.5f, 0}}, {{"splat.long", 1}, {"splat.degenerate", 1}}},
        {{.axis_u = {0, 0, 0}, .axis_v = {0, 0, 0}}, {{"splat.short", 1}, {"splat.degenerate", 1}}}};
    for (const auto& way : all_ways)
        for (const auto& c : cases) {
            IndirectRun run{.photons = {c.photon}, .parameters = free_parameters()};
            run.by(way);
            run.parameters.min_axis_pixels = 4;
            run.parameters.max_axis = 1.2f / shot.world.bounds.radius();
            auto counters = splat(shot, run).counters;
            for (const auto* key : {"splat.short", "splat.long", "splat.degenerate", "splat.not_finite"}) {
                const auto expected = c.counts.find(key);
                EXPECT_EQ(counters[key], expected == c.counts.end() ? 0u : expected->second)
                    << key << " of " << c.photon.axis_u.x;
            }
            EXPECT_NEAR(flux(shot, {0, 0, 1}).g, c.photon.flux.g, 0.01 * c.photon.flux.g)
                << way.name << " " << c.photon.axis_u.x;
        }
    IndirectRun run{
        .photons = {{.position_ws = {nan, 0, 0}}, {.flux = {1, nan, 1}}, {.flux = {1, INFINITY, 1}}},
        .parameters = free_parameters()};
    EXPECT_EQ(splat(shot, run).counters["splat.not_finite"], 3u);
    EXPECT_EQ(flux(shot, {0, 0, 1}), glm::dvec3(0));
}

TEST_F(IndirectSplatting, TooSmallListsOfTilesGrow) {
    const Shot shot(lit_square(), splat_camera({1, -2, 3}, {0, 0, 0}), splatting_size, splatting_size);
    IndirectRun run{.photons = many(20000, 2), .parameters = free_parameters()};
    run.parameters.splatting = li::Splatting::tiles;
    const auto report = splat(shot, run);
    EXPECT_GT(report.counters.at("splat.bin_entries"), 50000u);
    const auto expected = read("indirect.irradiance");
    graph().reset_history();
    run.initial_capacity = 1e-3;
    splat(shot, run);
    EXPECT_EQ(read("indirect.irradiance").pixels, expected.pixels);
}

TEST_F(IndirectSplatting, LightFromBehindTheSurfaceIsNotAdded) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 20);
    const Shot shot(small.scene(), splat_camera({0, 3, 3}, {0, 0, 0}), 32, 32);
    FreePhoton photon{.axis_v = {0, 0, 0.3f}, .normal = {0, 1, 0}};
    for (const auto& way : all_ways)
        for (const bool from_above : {true, false}) {
            photon.leg = from_above ? 0u : 1u << 16;  // against the map's direction +Y; along it
            IndirectRun run{.photons = {photon}, .parameters = free_parameters()};
            run.by(way);
            splat(shot, run);
            EXPECT_EQ(flux(shot, {0, 1, 0}).r > 0.5, from_above) << way.name;
        }
}

TEST_F(IndirectSplatting, DirectionsAreUploadedOnceForAWorld) {
    const Shot shot(lit_square(), splat_camera({0, 0, 4}, {0, 0, 0}), 16, 16);
    const auto uploads = [&](const char* world, int directions) {
        IndirectRun run{.photons = {FreePhoton{}}, .parameters = free_parameters()};
        run.parameters.maps.directions = directions;
        auto inputs = shot.inputs();
        inputs.world_fingerprint = world;
        graph::FrameOptions options;
        options.wanted = run.wanted;
        const auto report = graph().run(method(run), {}, inputs, options);
        const auto pass = std::find_if(report.passes.begin(), report.passes.end(),
                                       [](const auto& row) { return row.name == "upload arrivals"; });
        return pass != report.passes.end() && pass->slices > 0;
    };
    EXPECT_TRUE(uploads("a", 32));
    EXPECT_FALSE(uploads("a", 32));
    EXPECT_TRUE(uploads("a", 64));
    EXPECT_TRUE(uploads("b", 64)) << "its lights may have moved";
    EXPECT_FALSE(uploads("b", 64));
}

}  // namespace
}  // namespace ir::test
