// Samples of deep screen space filtered by their variance, in one frame and over several.
#include <cmath>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/image/metrics.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

const Settings light{{"paths", std::string("indirect")}, {"max_distance", 0.0}};
const Settings occlusion{{"paths", std::string("ao")}, {"max_distance", 1.0}};
const Settings by_variance{{"sample_filter", std::string("variance")}};

const Settings unfiltered{{"blur", false}};

Image picture(const std::string& method, const Settings& settings, int frames = 1) {
    engine::Experiment e;
    e.scene = "builtin:cornell";
    e.method = method;
    e.settings = settings;
    e.width = 64;
    e.height = 48;
    engine::Execution execution(machine(), e);
    for (int i = 0; i < frames; ++i) execution.run_frame({});
    return main_result(execution);
}

Image truth_of(const Settings& settings) {
    auto all = with(settings, {{"samples", std::int64_t{512}}});
    if (settings == light) all["max_bounces"] = std::int64_t{1};
    return picture("reference", all);
}

double error(const Image& found, const Image& truth) {
    return compute_metrics(found, truth, {"rmse"}).values.at("rmse");
}

double light_in(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < std::min(image.channels, 3); ++c) sum += double(image.at(x, y, c));
    return sum;
}

TEST(DssFilter, TakesTheNoiseOfSamplesAndKeepsMostOfTheirLight) {
    for (const auto& transport : {light, occlusion}) {
        SCOPED_TRACE(transport == light ? "light" : "occlusion");
        const auto truth = truth_of(transport);
        const auto found = picture("deep-screen-space", with(transport, by_variance)),
                   raw = picture("deep-screen-space", with(transport, unfiltered));
        EXPECT_LT(error(found, truth), 0.6 * error(raw, truth));
        // Bright samples that their neighbours lack count less.
        EXPECT_NEAR(light_in(found) / light_in(raw), 1, transport == light ? 0.1 : 0.03);
    }
}

TEST(DssFilter, FramesOfAStillCameraTakeMore) {
    const auto truth = truth_of(light);
    const auto settings = with(with(light, by_variance), {{"reprojection", true}});
    EXPECT_LT(error(picture("deep-screen-space", settings, 8), truth),
              0.95 * error(picture("deep-screen-space", settings, 1), truth));
}

}  // namespace
}  // namespace ir::test
