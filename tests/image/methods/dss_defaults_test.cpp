// At its defaults, on six levels and with visibility, deep screen space keeps light and occlusion.
#include <cstdlib>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/image/metrics.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

Image picture_of(const std::string& scene, const std::string& method, Settings settings,
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
    return main_result(execution);
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / double(image.pixels.size());
}

/// Over three seeds.
double mean_of(const std::string& scene, const Settings& settings) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
        sum += mean_of(picture_of(scene, "deep-screen-space", settings, seed)) / 3;
    return sum;
}

TEST(DssDefaults, KeepTheLightOfTheStillLife) {
    const std::string scene = "builtin:still-life";
    const Settings light{{"paths", std::string("indirect")},
                         {"max_distance", 0.0},
                         {"environment_light", false},
                         {"materials", std::string("lambert")}};
    const double truth = mean_of(picture_of(
        scene, "reference", with(light, {{"samples", std::int64_t{512}}, {"max_bounces", std::int64_t{1}}})));
    ASSERT_GT(truth, 0);
    EXPECT_NEAR(mean_of(scene, light) / truth, 1, 0.15);
}

/// Lit by an emissive panel alone, with walls that face outward.
TEST(DssDefaults, KeepTheLightOfAShippedRoom) {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) GTEST_SKIP() << "set INTERREFLECT_SCENES to the folder that has rooms/cornell-box";
    const auto scene = std::string(folder) + "/rooms/cornell-box/cornell-box.glb";
    const Settings light{{"paths", std::string("indirect")}, {"max_distance", 0.0}};
    const double truth = mean_of(picture_of(
        scene, "reference", with(light, {{"samples", std::int64_t{512}}, {"max_bounces", std::int64_t{1}}})));
    ASSERT_GT(truth, 0);
    const double found = mean_of(scene, light);
    EXPECT_GT(found, 0.85 * truth);
    EXPECT_LT(found, 1.1 * truth);
}

/// By half of its ꟻLIP, with glTF materials and highlights: docs/accuracy.md has larger pictures. Single
/// pixels decide the mean of the dominoes.
TEST(DssDefaults, AreAheadOfWhatTheScreenKnows) {
    const Settings light{{"paths", std::string("indirect")}, {"max_distance", 0.0}};
    const auto flip = [](const Image& image, const Image& truth) {
        return compute_metrics(image, truth, {"hdr-flip"}).values.at("hdr-flip");
    };
    for (const std::string scene : {"still-life", "conference", "cornell", "atrium", "dominoes"}) {
        SCOPED_TRACE(scene);
        const auto truth =
            picture_of("builtin:" + scene, "reference",
                       with(light, {{"samples", std::int64_t{256}}, {"max_bounces", std::int64_t{1}}}), 7);
        const auto own = picture_of("builtin:" + scene, "deep-screen-space", light),
                   other = picture_of("builtin:" + scene, "ssdo", light);
        const double part = scene == "atrium" || scene == "dominoes" ? 0.75 : 0.55;
        EXPECT_LT(flip(own, truth), part * flip(other, truth));
        const double tolerance = scene == "dominoes" ? 0.5 : 0.12;
        EXPECT_NEAR(mean_of(own) / mean_of(truth), 1, tolerance);
    }
}

TEST(DssDefaults, KeepTheOcclusionOfTheAtrium) {
    const std::string scene = "builtin:atrium";
    const Settings within{{"max_distance", 3.0}};
    const double truth = mean_of(picture_of(
        scene, "reference", with(within, {{"paths", std::string("ao")}, {"samples", std::int64_t{256}}})));
    EXPECT_NEAR(mean_of(scene, within), truth, 0.03);
}

}  // namespace
}  // namespace ir::test
