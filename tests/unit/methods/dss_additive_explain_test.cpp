// What explains a pixel without visibility: all surfels that were added to it give what it holds.
#include "renderers/passes/bounce/receiver.h"
#include "shaders/methods/deep-screen-space/splatting/explain_additive.comp.h"
#include "tests/unit/methods/dss_additive_fixture.h"

namespace ir::test {
namespace {

class AdditiveExplained : public AdditiveTest {
  protected:
    static graph::Method method(const AdditiveRun& run) {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs =
            joined({dss::hierarchy_outputs(), dss::splat_outputs(), dss::additive_outputs()});
        method.setup = [run](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            const auto hierarchy = dss::shuffle(builder, gbuffer, run.parameters);
            dss::splat_additive(builder, scene, gbuffer,
                                passes::shadow_maps(builder, scene, 256, Transport::Materials::lambert),
                                hierarchy, upload(builder, run.surfels), run.parameters,
                                {"result", "Result"});
        };
        return method;
    }

    static float amount(const dss::AdditiveShare& share) {
        float sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += share.given[c] + share.glossy[c];
        return sum;
    }

    /// Levels of three pixels, each with what was found and what is there.
    void expect_explained(const AdditiveRun& run) {
        auto scene = floor().scene;
        scene.materials[0].metallic = 0;
        const Shot shot(scene, dss_camera({0, 3, 0}, {0, 0, 0}, true, 2), 32, 32);
        graph::FrameOptions options;
        options.wanted = {"additive.*", "result"};
        auto inputs = shot.inputs();
        run_method(method(run), {}, inputs, options);
        int given = 0;
        for (const auto pixel : {glm::ivec2(16, 16), {3, 27}, {25, 9}}) {
            inputs.inspection = {pixel.x, pixel.y, {}};
            ASSERT_TRUE(graph().explain(method(run), {}, inputs, options));
            const auto levels = elements<dss::AdditiveLevel>("additive.explain.levels");
            const auto shares = elements<dss::AdditiveShare>("additive.explain.surfels");
            ASSERT_EQ(levels.size(), static_cast<std::size_t>(run.parameters.levels));
            std::size_t found = 0;
            for (const auto& level : levels) {
                found += level.surfels;
                const auto stored = read("additive.levels", static_cast<int>(level.level));
                EXPECT_FLOAT_EQ(level.kept[0], stored.at(pixel.x, pixel.y, 0));
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(level.given[c], level.kept[c], 1e-4f * (0.01f + level.kept[c]));
                    given += level.given[c] > 0;
                }
            }
            EXPECT_EQ(shares.size(), found);
            for (std::size_t i = 1; i < shares.size(); ++i)
                EXPECT_GE(amount(shares[i - 1]), 0.999f * amount(shares[i]));
        }
        EXPECT_GE(given, 9);
    }
};

TEST_F(AdditiveExplained, SurfelsGiveWhatThePixelHolds) {
    for (const bool light : {false, true})
        for (const int levels : {1, 4}) {
            SCOPED_TRACE(std::string(light ? "light, " : "occlusion, ") + std::to_string(levels) + " levels");
            AdditiveRun run{.surfels = square_above(0.4f, 1, 24, glm::vec3(2))};
            run.parameters.levels = levels;
            run.parameters.transport.max_distance = 4;
            if (light) run.parameters.transport.paths = Transport::Paths::indirect;
            expect_explained(run);
        }
}

/// They are not drawn where nothing sends highlights.
TEST_F(AdditiveExplained, DarkSurfelsAreNotListed) {
    AdditiveRun run{.surfels = square_above(0.4f, 1, 24, glm::vec3(2))};
    for (const auto& dark : square_above(0.6f, 1, 24, glm::vec3(0))) run.surfels.push_back(dark);
    run.parameters.levels = 4;
    run.parameters.glossy_senders = false;
    run.parameters.transport.max_distance = 4;
    run.parameters.transport.paths = Transport::Paths::indirect;
    expect_explained(run);
    for (const auto& share : elements<dss::AdditiveShare>("additive.explain.surfels"))
        EXPECT_GT(amount(share), 0);
}

}  // namespace
}  // namespace ir::test
