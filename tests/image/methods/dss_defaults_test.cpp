// At its defaults, on six levels and with visibility, deep screen space keeps the light of rooms and their
// occlusion. As published it does not.
#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

double mean_of(const std::string& scene, const std::string& method, Settings settings,
               std::uint64_t seed = 1) {
    engine::Experiment e;
    e.scene = scene;
    e.method = method;
    e.settings = std::move(settings);
    e.width = 48;
    e.height = 32;
    e.seed = seed;
    engine::Execution execution(machine(), e);
    execution.run_frame({});
    const auto image = main_result(execution);
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / double(image.pixels.size());
}

Settings published() {
    return {{"placement", std::string("random")},
            {"sub_images", std::string("independent")},
            {"backs", std::string("lit")},
            {"discs", std::string("above")},
            {"level0", std::string("discs")},
            {"last_shell", std::string("ends")},
            {"coverage", 1.0},
            {"trade_off", 0.05}};
}

/// Means over three seeds.
double over_seeds(const std::string& scene, const Settings& settings) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        sum += mean_of(scene, "deep-screen-space", settings, seed) / 3;
    return sum;
}

TEST(DssDefaults, KeepTheLightOfTheStillLife) {
    const std::string scene = "builtin:still-life";
    const Settings light{{"paths", std::string("indirect")},
                         {"max_distance", 0.0},
                         {"environment_light", false},
                         {"materials", std::string("lambert")}};
    const double truth = mean_of(
        scene, "reference", with(light, {{"samples", std::int64_t{512}}, {"max_bounces", std::int64_t{1}}}));
    ASSERT_GT(truth, 0);
    const double found = over_seeds(scene, light) / truth;
    EXPECT_GT(found, 0.85);
    EXPECT_LT(found, 1.15);
    EXPECT_LT(over_seeds(scene, with(light, published())) / truth, 0.8);
    machines().clear();
}

TEST(DssDefaults, KeepTheOcclusionOfTheAtrium) {
    const std::string scene = "builtin:atrium";
    const Settings within{{"max_distance", 3.0}};
    const double truth = mean_of(
        scene, "reference", with(within, {{"paths", std::string("ao")}, {"samples", std::int64_t{256}}}));
    EXPECT_NEAR(over_seeds(scene, within), truth, 0.03);
    machines().clear();
}

}  // namespace
}  // namespace ir::test
