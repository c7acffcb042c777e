// Ambient occlusion volumes with visibility: exact rays, so without a blur their mean is the reference.
#include <cmath>

#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

const graph::Method& method_of(const std::string& id) {
    for (const auto* method : methods::all_methods())
        if (method->description.id == id) return *method;
    throw std::runtime_error("no method " + id);
}

Settings settings_of(int samples, const std::string& falloff, double reach = 1) {
    return {{"samples", std::int64_t{samples}},
            {"spread", std::string("independent")},
            {"blur", false},
            {"max_distance", reach},
            {"falloff", falloff}};
}

Image accessibility(const Settings& settings, const std::string& scene, std::uint64_t seed) {
    const auto& method = method_of("ambient-occlusion-volumes");
    engine::Experiment experiment;
    experiment.scene = scene;
    experiment.method = method.description.id;
    experiment.settings = completed(method.description.parameters, settings);
    experiment.width = 32;
    experiment.height = 24;
    experiment.seed = seed;
    engine::Execution execution(machine(), experiment);
    execution.run_frame({});
    return execution.main_result();
}

Image reference(const std::string& falloff, const std::string& scene, double reach = 1) {
    const auto& method = method_of("reference");
    engine::Experiment experiment;
    experiment.scene = scene;
    experiment.method = method.description.id;
    experiment.settings = completed(method.description.parameters, {{"paths", std::string("ao")},
                                                                    {"max_distance", reach},
                                                                    {"falloff", falloff},
                                                                    {"primary", std::string("gbuffer")},
                                                                    {"samples", std::int64_t{4096}}});
    experiment.width = 32;
    experiment.height = 24;
    engine::Execution execution(machine(), experiment);
    execution.run_frame({});
    return execution.main_result();
}

class AmbientOcclusionVolumes : public testing::Test {
  protected:
    static void TearDownTestSuite() { machines().clear(); }
};

/// Mean of the published estimator over runs of 16 samples, which is unbiased, and its variance by pixel.
struct Mean {
    std::vector<double> mean, variance_of_mean;
};

Mean mean_of(Settings settings, const std::string& scene, int runs) {
    settings["estimator"] = std::string("published");
    std::vector<double> sum, squares;
    for (int i = 0; i < runs; ++i) {
        const auto image = accessibility(settings, scene, 100 + i);
        sum.resize(image.pixels.size());
        squares.resize(image.pixels.size());
        for (std::size_t p = 0; p < sum.size(); ++p) {
            sum[p] += image.pixels[p];
            squares[p] += double(image.pixels[p]) * image.pixels[p];
        }
    }
    Mean result;
    for (std::size_t p = 0; p < sum.size(); ++p) {
        const double mean = sum[p] / runs;
        result.mean.push_back(mean);
        result.variance_of_mean.push_back(std::max(0.0, squares[p] / runs - mean * mean) / (runs - 1));
    }
    return result;
}

/// Squared z of all pixels that have a variance, per pixel: 1 up to noise where both agree.
double mean_squared_z(const Mean& found, const Image& expected) {
    double sum = 0;
    int n = 0;
    for (std::size_t p = 0; p < found.mean.size(); ++p) {
        const double v = expected.pixels[p], own = v * (1 - v) / 4096;  // at most
        if (found.variance_of_mean[p] < 1e-8) continue;
        sum += std::pow(found.mean[p] - v, 2) / (found.variance_of_mean[p] + own);
        ++n;
    }
    return sum / std::max(1, n);
}

TEST_F(AmbientOcclusionVolumes, WithVisibilityTheMeanIsTheReference) {
    // 768 pixels, 24 runs of 16 rays. z² of a t with 23 degrees of freedom: mean 23/21, variance 2.9; the
    // mean of all exceeds 1.095 + 3.72 √(2.9/700) = 1.33 with alpha = 1e-4. The mutant of another reach must.
    for (const std::string scene : {"builtin:cornell", "builtin:atrium?detail=0.05"}) {
        const double reach = scene == "builtin:cornell" ? 1.0 : 0.5;
        const auto expected = reference("hard", scene, reach);
        const auto found = mean_of(settings_of(16, "hard", reach), scene, 24);
        EXPECT_LT(mean_squared_z(found, expected), 1.33) << scene;
        const auto mutant = mean_of(settings_of(16, "hard", 0.9 * reach), scene, 24);
        EXPECT_GT(mean_squared_z(mutant, expected), 1.33) << scene;
    }
}

TEST_F(AmbientOcclusionVolumes, TheErrorFallsWithTheRootOfTheSamples) {
    for (const std::string falloff : {"hard", "smooth"}) {
        const auto expected = reference(falloff, "builtin:cornell");
        const auto rmse = [&](int samples) {
            double sum = 0;
            const auto image = accessibility(settings_of(samples, falloff), "builtin:cornell", 3);
            for (std::size_t p = 0; p < image.pixels.size(); ++p)
                sum += std::pow(image.pixels[p] - expected.pixels[p], 2);
            return std::sqrt(sum / static_cast<double>(image.pixels.size()));
        };
        const double four = rmse(4), sixteen = rmse(16);
        EXPECT_NEAR(four / sixteen, 2, 0.35) << falloff << " " << four << " " << sixteen;
    }
}

}  // namespace
}  // namespace ir::test
