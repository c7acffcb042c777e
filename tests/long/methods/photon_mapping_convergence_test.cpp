// Unfiltered photon mapping against the path-traced reference of the same transport, where surfaces are flat:
// the error falls with the root of the number of photons, and the light is as much as it should be.
#include <gtest/gtest.h>

#include <cmath>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"

namespace ir::engine {
namespace {

constexpr int seeds = 8;
/// Student's t of 7 degrees of freedom, both sides, alpha = 1e-4.
constexpr double t_quantile = 7.84;

/// A lamp over the table; one bounce of diffuse light.
Experiment experiment(const std::string& method) {
    Experiment e;
    e.scene = "builtin:still-life";
    e.camera_name = "table";
    e.method = method;
    e.width = 64, e.height = 40;
    e.settings = {{"paths", std::string("indirect")},
                  {"max_bounces", std::int64_t{1}},
                  {"materials", std::string("lambert")},
                  {"normal_maps", false}};
    scene::Light lamp;
    lamp.type = scene::LightType::spot;
    lamp.position = {-0.9f, 2.3f, 0.9f};
    lamp.direction = glm::normalize(glm::vec3(0.1f, 0.75f, 0) - lamp.position);
    lamp.intensity = 260;
    lamp.inner_angle = 0.48f, lamp.outer_angle = 0.61f;
    e.lights = {lamp};
    e.replace_lights = true;
    e.environment = scene::Environment{glm::vec3(0), nullptr};
    return e;
}

/// Round kernels, all of one radius: 0.01 of that of the scene's bounds.
Experiment photons(std::int64_t count, std::uint64_t seed) {
    auto e = experiment("photon-mapping");
    e.seed = seed;
    const Settings settings = {{"photons", count},
                               {"tracer", std::string("embree")},
                               {"rsm_resolution", std::string("1024")},
                               {"sum_precision", std::string("single-float")},
                               {"min_radius", 0.01},
                               {"max_radius", 0.01},
                               {"min_radius_texels", 0.0},
                               {"ray_length_scale", 1e-4},
                               {"max_stretch", 1.0},
                               {"directional", false},
                               {"temporal", false},
                               {"filter_passes", std::int64_t{0}}};
    for (const auto& [key, value] : settings) e.settings[key] = value;
    return e;
}

struct Estimate {
    double mean, error;  ///< of the mean
};

Estimate estimate(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / double(values.size());
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / double(values.size() * (values.size() - 1)))};
}

class PhotonConvergence : public testing::Test {
  protected:
    struct Outcome {
        double error2, mean;  ///< over the flat pixels and their channels; without the reference's noise
    };

    void SetUp() override {
        auto e = experiment("reference");
        e.settings["samples"] = std::int64_t{2048};
        Execution truth(machine_, e);
        graph::FrameOptions options;
        options.wanted = {"gbuffer.*", "valid", "reference.variance"};
        truth.run_frame(options);
        expected_ = main_result(truth);
        const auto layer = [&](const char* key) { return truth.graph().read_image(key).value(); };
        find_flat_pixels(layer("gbuffer.geometric_normal"), layer("gbuffer.position"));
        ASSERT_GT(flat_.size(), 500u);
        noise2_ = mean_of(layer("reference.variance"));
        expected_mean_ = mean_of(expected_);
    }

    /// Those all of whose neighbours, up to three pixels away, lie in one plane.
    void find_flat_pixels(const Image& normal, const Image& position) {
        const auto vector = [](const Image& image, int x, int y) {
            return glm::vec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
        };
        const auto is_flat = [&](int x, int y) {
            const auto n = vector(normal, x, y), p = vector(position, x, y);
            for (int v = y - 3; v <= y + 3; ++v)
                for (int u = x - 3; u <= x + 3; ++u)
                    if (glm::dot(n, vector(normal, u, v)) < 0.99f ||
                        std::abs(glm::dot(n, vector(position, u, v) - p)) > 0.015f)
                        return false;
            return true;
        };
        for (int y = 3; y < normal.height - 3; ++y)
            for (int x = 3; x < normal.width - 3; ++x)
                if (is_flat(x, y)) flat_.emplace_back(x, y);
    }

    double mean_of(const Image& image) const {
        double sum = 0;
        for (const auto& at : flat_)
            for (int c = 0; c < 3; ++c) sum += image.at(at.x, at.y, c);
        return sum / double(3 * flat_.size());
    }

    Outcome outcome(const Experiment& e) {
        Execution execution(machine_, e);
        execution.run_frame({});
        const auto actual = main_result(execution);
        double sum = 0;
        for (const auto& at : flat_)
            for (int c = 0; c < 3; ++c) {
                const double difference = actual.at(at.x, at.y, c) - expected_.at(at.x, at.y, c);
                sum += difference * difference;
            }
        return {sum / double(3 * flat_.size()) - noise2_, mean_of(actual)};
    }

    Machine machine_;
    Image expected_;
    std::vector<glm::ivec2> flat_;
    double noise2_ = 0, expected_mean_ = 0;
};

/// Of log RMSE over log N, where N grows by 16.
double slope(double error2_few, double error2_many) {
    return std::log(error2_many / error2_few) / 2 / std::log(16.0);
}

// n = 8 seeds, each with a slope of its own; alpha = 1e-4.
TEST_F(PhotonConvergence, HasTheSlopeOfIndependentPhotons) {
    std::vector<double> fixed, mutant, flux;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto few = outcome(photons(25000, seed)), many = outcome(photons(400000, seed));
        fixed.push_back(slope(few.error2, many.error2));
        flux.push_back(many.mean / expected_mean_);
        // the mutant: as many photons in a kernel, however many there are
        auto growing = photons(25000, seed);
        growing.settings["min_radius"] = 0.0;
        growing.settings["max_radius"] = 10.0;
        growing.settings["kernel_scale"] = 1.0;
        const auto few_adaptive = outcome(growing);
        growing.settings["photons"] = std::int64_t{400000};
        mutant.push_back(slope(few_adaptive.error2, outcome(growing).error2));
    }
    const auto measured = estimate(fixed), adaptive = estimate(mutant), light = estimate(flux);
    std::printf(
        "slope %.3f +- %.3f, of kernels with a constant number of photons %.3f +- %.3f; "
        "light %.4f +- %.4f\n",
        measured.mean, measured.error, adaptive.mean, adaptive.error, light.mean, light.error);
    EXPECT_NEAR(measured.mean, -0.5, 0.1);
    EXPECT_LT(t_quantile * measured.error, 0.1) << "too uncertain to tell";
    EXPECT_GT(adaptive.mean - t_quantile * adaptive.error, -0.4) << "the test passes what does not converge";

    // Kernels of 0.01 blur little where it is flat. (The printed power scaling is rejected on one wall by
    // tests/image/methods/photon_mapping_test.cpp.)
    EXPECT_NEAR(light.mean, 1, t_quantile * light.error);
    EXPECT_LT(t_quantile * light.error, 0.1) << "too uncertain to tell";
}

}  // namespace
}  // namespace ir::engine
