// Glossy reflection through maps: what interfaces see is where exact rays say, as bright as the reference
// says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/engine/pictures.h"
#include "ldm_ao_fixture.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

Settings gloss(const char* kind, const char* tracer, std::int64_t samples = 1, const Settings& more = {}) {
    Settings settings{{"gloss", std::string(kind)},
                      {"gloss_tracer", std::string(tracer)},
                      {"gloss_samples", samples},
                      {"directions", std::int64_t{64}},
                      {"emission", std::int64_t{4}}};
    for (const auto& [key, value] : more) settings[key] = value;
    return settings;
}

class LdmIndirectGloss : public ldm_ao_test::LdmAo {
  protected:
    std::string id() const override { return "ldm-indirect"; }
    void SetUp() override {
        LdmAo::SetUp();
        processor = Processor::host;
        load("builtin:still-life");
    }
    Image look(const Settings& settings, const char* key) {
        return render(camera("table"), 64, 48, settings, {}, 0, key);
    }
    bool has_pass(const std::string& name) const {
        return std::ranges::any_of(report.passes, [&](const auto& p) { return p.name == name && !p.culled; });
    }
};

/// Part of the pixels that have the same distance within 5 %, or nothing in both.
double agreement(const Image& found, const Image& exact) {
    double agree = 0;
    for (std::size_t i = 0; i < exact.pixels.size(); ++i)
        agree += std::abs(found.pixels[i] - exact.pixels[i]) <= 0.05f * exact.pixels[i];
    return agree / static_cast<double>(exact.pixels.size());
}

TEST_F(LdmIndirectGloss, MirrorsSeeWhatExactRaysSee) {
    const auto exact = look(gloss("mirror", "rays"), "gloss.distance");
    const auto of = [&](const char* tracer, const Settings& more) {
        return agreement(look(gloss("mirror", tracer, 1, more), "gloss.distance"), exact);
    };
    const double along = of("maps", {{"gloss_landing", std::string("direction")}, {"gloss_near", 0.0}}),
                 on_planes = of("maps", {{"gloss_near", 0.0}}), near = of("maps", {}),
                 finer = of("maps", {{"directions", std::int64_t{256}}}), cube = of("cube", {});
    std::printf(
        "agree with exact rays: %.3f along maps, %.3f on planes, %.3f nearby, %.3f of 256, %.3f cube\n",
        along, on_planes, near, finer, cube);
    EXPECT_GT(on_planes, along + 0.05);
    EXPECT_GT(near, on_planes);
    EXPECT_GT(finer, near);
    EXPECT_GT(near, 0.86);
    EXPECT_GT(cube, 0.9);
}

TEST_F(LdmIndirectGloss, ThreadsChangeNothingAndNothingIsThereWithoutIt) {
    std::vector<Image> pictures;
    for (const int count : {1, 3}) {
        threads = count;
        pictures.push_back(look(gloss("lobe", "maps", 2, {{"max_bounces", std::int64_t{2}}}), "radiance"));
        EXPECT_TRUE(has_pass("gloss"));
    }
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
    const auto without = look(gloss("none", "maps"), "radiance");
    EXPECT_FALSE(has_pass("gloss"));
    EXPECT_NE(pictures[0].pixels, without.pixels);
    for (const auto& [key, value] :
         Settings{{"materials", std::string("lambert")}, {"paths", std::string("direct")}}) {
        look(gloss("lobe", "maps", 1, {{key, value}}), "radiance");
        EXPECT_FALSE(has_pass("gloss")) << key;
    }
}

struct StillLife {
    Image radiance;
    std::optional<Image> material;  ///< "gbuffer.material"; the reference has none
};

StillLife glossy_still_life(const std::string& method, const Settings& settings) {
    engine::Experiment e;
    e.scene = "builtin:still-life";
    e.camera_name = "table";
    e.method = method;
    e.settings = settings;
    e.settings["paths"] = std::string("indirect");
    e.settings["max_bounces"] = std::int64_t{3};
    e.width = 72, e.height = 54;
    engine::Execution execution(machine(), e);
    graph::FrameOptions options;
    options.wanted = {"gbuffer.material"};
    execution.run_frame(options);
    return {main_result(execution), execution.graph().read_image("gbuffer.material")};
}

/// Of the still life's metals, where all neighbours are of the same one: W/(m² sr) in all.
double light_of_metals(const Image& picture, const Image& material) {
    double sum = 0;
    int pixels = 0;
    for (int y = 1; y + 1 < picture.height; ++y)
        for (int x = 1; x + 1 < picture.width; ++x) {
            bool is_inside = material.at(x, y, 0) > 0.5f;
            for (int k = 0; k < 9; ++k)
                is_inside &= material.at(x + k % 3 - 1, y + k / 3 - 1, 3) == material.at(x, y, 3);
            if (!is_inside) continue;
            ++pixels;
            for (int c = 0; c < 3; ++c) sum += picture.at(x, y, c);
        }
    EXPECT_GT(pixels, 20);
    return sum;
}

// Metals reflect what they see, with several bounces: exact rays are unbiased, and maps are near. Without
// gloss they are black.
TEST(LdmIndirectGlossPicture, MetalsAreAsBrightAsTheReferenceSays) {
    const auto by_rays = glossy_still_life("ldm-indirect", gloss("lobe", "rays", 32));
    ASSERT_TRUE(by_rays.material);
    const auto light = [&](const StillLife& picture) {
        return light_of_metals(picture.radiance, *by_rays.material);
    };
    const auto rays = light(by_rays),
               maps = light(glossy_still_life("ldm-indirect", gloss("lobe", "maps", 32))),
               none = light(glossy_still_life("ldm-indirect", gloss("none", "maps"))),
               truth = light(glossy_still_life("reference", {{"samples", std::int64_t{128}}}));
    std::printf("light of metals over the reference's: rays %.3f, maps %.3f, none %.3f\n", rays / truth,
                maps / truth, none / truth);
    EXPECT_NEAR(rays / truth, 1, 0.08);
    EXPECT_NEAR(maps / rays, 1, 0.05);
    EXPECT_LT(none, 0.02 * truth);
}

}  // namespace
}  // namespace ir::test
