// Layered depth maps against the path-traced reference of the same transport: errors fall as directions,
// texels and photons grow, with the slopes that were recorded, and only as long as all three grow.
#include <gtest/gtest.h>

#include <cmath>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "tests/image/methods/flat_pixels.h"

namespace ir::engine {
namespace {

/// The Cornell box with a spot under its ceiling in place of its lamp, 64 x 64 pixels.
Experiment experiment(const std::string& method, const Settings& settings) {
    Experiment e;
    e.scene = "builtin:cornell?emission=0";
    e.camera_name = "front";
    e.method = method;
    e.width = e.height = 64;
    e.settings = settings;
    e.settings["normal_maps"] = false;
    scene::Light spot;
    spot.type = scene::LightType::spot;
    spot.position = {0, 0.53f, -0.28f};
    spot.direction = {0, -1, 0};
    spot.inner_angle = glm::radians(45.0f), spot.outer_angle = glm::radians(55.0f);
    e.lights = {spot};
    e.replace_lights = true;
    e.environment = scene::Environment{glm::vec3(0), nullptr};
    return e;
}

Settings with(Settings settings, const Settings& more) {
    for (const auto& [key, value] : more) settings[key] = value;
    return settings;
}

const Settings bounce{{"paths", std::string("indirect")}, {"materials", std::string("lambert")}};
const Settings occlusion{{"paths", std::string("ao")}, {"max_distance", 0.3}};

struct Outcome {
    double flat, all;   ///< RMSE without the reference's noise: flat pixels, every valid one
    double flat_light;  ///< mean over that of the reference
    double light;       ///< of every valid pixel
};

class LdmConvergence : public testing::Test {
  protected:
    /// The method has no random numbers; the reference's variance is subtracted.
    void compute_reference(const Settings& transport, std::int64_t samples) {
        Execution truth(machine_, experiment("reference", with(transport, {{"samples", samples}})));
        graph::FrameOptions options;
        options.wanted = {"gbuffer.*", "valid", "reference.variance"};
        truth.run_frame(options);
        const auto image = [&](const char* key) { return truth.graph().read_image(key).value(); };
        expected_ = main_result(truth);
        variance_ = image("reference.variance");
        flat_ = test::flat_pixels(image("gbuffer.geometric_normal"), image("gbuffer.position"), 3, 0.008f);
        ASSERT_GT(flat_.size(), 1000u);
        const auto valid = image("valid");
        for (int y = 0; y < valid.height; ++y)
            for (int x = 0; x < valid.width; ++x)
                if (valid.at(x, y) > 0.5f) all_.emplace_back(x, y);
    }

    Outcome outcome(const char* method, const Settings& settings) {
        Execution execution(machine_, experiment(method, settings));
        execution.run_frame({});
        const auto actual = main_result(execution);
        const int channels = std::min(3, expected_.channels);
        const auto compare = [&](const std::vector<glm::ivec2>& pixels, double& rmse, double& light) {
            double squares = 0, found = 0, expected = 0;
            for (const auto& p : pixels)
                for (int c = 0; c < channels; ++c) {
                    const double e = expected_.at(p.x, p.y, c), a = actual.at(p.x, p.y, c);
                    squares +=
                        (a - e) * (a - e) - variance_.at(p.x, p.y, std::min(c, variance_.channels - 1));
                    found += a, expected += e;
                }
            rmse = std::sqrt(std::max(squares, 0.0) / (channels * double(pixels.size())));
            light = found / expected;
        };
        Outcome o{};
        compare(flat_, o.flat, o.flat_light);
        compare(all_, o.all, o.light);
        return o;
    }

    /// As published, without photons whose middle is not seen, unless `more` says otherwise.
    Outcome indirect(int directions, int emission, int resolution = 200, const Settings& more = {}) {
        const auto o = outcome("ldm-indirect", with(bounce, with({{"directions", std::int64_t{directions}},
                                                                  {"emission", std::int64_t{emission}},
                                                                  {"resolution", std::int64_t{resolution}},
                                                                  {"clipping", std::string("none")},
                                                                  {"reject_hidden", true}},
                                                                 more)));
        std::printf("%4d directions, %3d^2 photons, %3d^2 texels: RMSE flat %.5f all %.5f, light %.4f %.4f\n",
                    directions, emission, resolution, o.flat, o.all, o.flat_light, o.light);
        return o;
    }

    Outcome ao(int directions, int resolution, const char* exact) {
        const auto o = outcome("ldm-ao", with(occlusion, {{"directions", std::int64_t{directions}},
                                                          {"resolution", std::int64_t{resolution}},
                                                          {"exact", std::string(exact)}}));
        std::printf("%4d directions, %3d^2 texels, exact %-4s: RMSE flat %.5f all %.5f\n", directions,
                    resolution, exact, o.flat, o.all);
        return o;
    }

  private:
    Machine machine_;
    Image expected_, variance_;
    std::vector<glm::ivec2> flat_, all_;
};

/// Of log RMSE over log n, by least squares.
double slope(const std::vector<double>& n, const std::vector<double>& rmse) {
    double x = 0, y = 0, xx = 0, xy = 0;
    const double count = double(n.size());
    for (std::size_t i = 0; i < n.size(); ++i) {
        const double u = std::log(n[i]), v = std::log(rmse[i]);
        x += u / count, y += v / count, xx += u * u / count, xy += u * v / count;
    }
    return (xy - x * y) / (xx - x * x);
}

// Footprints of N directions and E² photons have an area of the order of 1/N + 1/E². Where it is flat, what
// is left is their unevenness, which falls with the number of photons over a place, and their blur, which
// falls with the area. At edges light is missing in a band as wide as they are: a constant error in it would
// make that of the whole picture go with the fourth root of the area, N^-1/4. It falls faster, and fastest in
// the last step, which this does not explain: both slopes below are recorded values, no theory's.
TEST_F(LdmConvergence, OfIndirectLightAsDirectionsAndPhotonsGrow) {
    compute_reference(with(bounce, {{"max_bounces", std::int64_t{1}}}), 2048);
    const std::vector<double> n{32, 128, 512};
    std::vector<double> flat, all, missing, few_photons, few_directions;
    for (const double directions : n) {
        const int emission = int(std::lround(std::sqrt(32 * directions)));
        const auto o = indirect(int(directions), emission);
        flat.push_back(o.flat);
        all.push_back(o.all);
        missing.push_back(1 - o.light);
        if (directions == n.back()) {
            EXPECT_NEAR(o.flat_light, 1, 0.01);
            EXPECT_NEAR(o.light, 1, 0.03);
        }
        // the mutants: one of both alone
        few_photons.push_back(indirect(int(directions), 16).flat);
        few_directions.push_back(directions == n.front() ? flat.front() : indirect(32, emission).flat);
    }
    std::printf("slopes over N: flat %.3f, all %.3f; with 16^2 photons %.3f, with 32 directions %.3f\n",
                slope(n, flat), slope(n, all), slope(n, few_photons), slope(n, few_directions));
    EXPECT_NEAR(slope(n, flat), -0.72, 0.1);
    EXPECT_NEAR(slope(n, all), -0.38, 0.08);
    EXPECT_LT(std::log(all[2] / all[1]), std::log(all[1] / all[0])) << "a plateau";
    EXPECT_LT(missing[2], missing[0]);
    EXPECT_GT(slope(n, few_photons), -0.2) << "the test passes what does not converge";
    EXPECT_GT(slope(n, few_directions), -0.2) << "the test passes what does not converge";
}

// What texels and the rejection of hidden photons add at edges; flat pixels hardly know of them.
TEST_F(LdmConvergence, OfIndirectLightAsTexelsGrow) {
    compute_reference(with(bounce, {{"max_bounces", std::int64_t{1}}}), 1024);
    std::vector<Outcome> by_texels;
    for (const int resolution : {25, 50, 100, 200}) by_texels.push_back(indirect(128, 64, resolution));
    for (std::size_t i = 1; i < by_texels.size(); ++i) {
        EXPECT_LT(by_texels[i].all, by_texels[i - 1].all);
        EXPECT_GT(by_texels[i].light, by_texels[i - 1].light);
        EXPECT_NEAR(by_texels[i].flat, by_texels.back().flat, 0.1 * by_texels.back().flat);
    }
    const auto kept = indirect(128, 64, 200, {{"reject_hidden", false}});
    EXPECT_LT(kept.all, 0.96 * by_texels.back().all);
    EXPECT_GT(kept.light, by_texels.back().light);
    EXPECT_NEAR(kept.flat, by_texels.back().flat, 1e-4);
}

/// What is left of `rmse` without what the same directions have with exact hits.
double without(double rmse, double of_directions) {
    return std::sqrt(std::max(rmse * rmse - of_directions * of_directions, 0.0));
}

// Exact hits leave the error of the directions, which falls faster than the root of their number (-1/2 is
// what independent directions would have). What maps add lies in bands along edges that are as wide as a
// texel, so that it falls with the root of the texels; exact hits nearby take most of it away.
TEST_F(LdmConvergence, OfAmbientOcclusionAsDirectionsAndTexelsGrow) {
    compute_reference(occlusion, 4096);
    const std::vector<double> n{32, 128, 512}, texels{25, 50, 100, 200};
    std::vector<double> directions, flat, added;
    for (const double count : n) {
        directions.push_back(ao(int(count), 200, "all").all);
        flat.push_back(ao(int(count), 200, "none").flat);
    }
    Outcome maps{};
    for (const double side : texels) {
        maps = ao(512, int(side), "none");
        added.push_back(without(maps.all, directions.back()));
    }
    const double near = without(ao(512, 200, "near").all, directions.back());
    std::printf(
        "slopes: directions %.3f, flat pixels %.3f, texels %.3f; near hits exact: %.5f of %.5f left\n",
        slope(n, directions), slope(n, flat), slope(texels, added), near, added.back());
    EXPECT_NEAR(slope(n, directions), -0.63, 0.08);
    EXPECT_NEAR(slope(n, flat), -0.65, 0.08);
    EXPECT_NEAR(slope(texels, added), -0.46, 0.12);
    EXPECT_LT(near, 0.7 * added.back());
    EXPECT_NEAR(maps.light, 1, 0.01);
    // the mutant: more directions through maps of few texels
    const std::vector<double> coarse{ao(128, 25, "none").all, ao(512, 25, "none").all};
    EXPECT_GT(slope({128, 512}, coarse), -0.2) << "the test passes what does not converge";
}

}  // namespace
}  // namespace ir::engine
