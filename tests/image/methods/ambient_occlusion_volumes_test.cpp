// Ambient occlusion volumes with visibility: exact rays, so without a blur their mean is the reference.
#include <cmath>

#include "app/engine/pictures.h"
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
    return main_result(execution);
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
    return main_result(execution);
}

class AmbientOcclusionVolumes : public testing::Test {
  protected:
    static void TearDownTestSuite() { machines().clear(); }
};

/// |t| of the mean error over a rectangle: pixels draw their rays independently.
double t_of(const Image& found, const Image& expected, glm::ivec2 first, glm::ivec2 end) {
    double sum = 0, squares = 0;
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            const double error = static_cast<double>(found.at(x, y)) - expected.at(x, y);
            sum += error;
            squares += error * error;
        }
    return squares > 0 ? std::abs(sum) / std::sqrt(squares) : 0;
}

TEST_F(AmbientOcclusionVolumes, WithVisibilityTheMeanIsTheReference) {
    // 16 rays of each of 768 pixels; published, the estimator has no bias. The picture, and each of its 12
    // blocks of 64 pixels: two-sided, alpha = 1e-4 all together. The mutant is another reach.
    for (const std::string scene : {"builtin:cornell", "builtin:atrium?detail=0.05"}) {
        const double reach = scene == "builtin:cornell" ? 0.3 : 1.0;
        const auto expected = reference("hard", scene, reach);
        auto settings = settings_of(16, "hard", reach);
        settings["estimator"] = std::string("published");
        const auto found = accessibility(settings, scene, 5);
        EXPECT_LT(t_of(found, expected, {0, 0}, {32, 24}), 4.5) << scene;
        for (int y = 0; y < 24; y += 8)
            for (int x = 0; x < 32; x += 8)
                EXPECT_LT(t_of(found, expected, {x, y}, {x + 8, y + 8}), 4.8) << scene << x << " " << y;
        settings["max_distance"] = 0.5 * reach;
        EXPECT_GT(t_of(accessibility(settings, scene, 5), expected, {0, 0}, {32, 24}), 4.5) << scene;
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
