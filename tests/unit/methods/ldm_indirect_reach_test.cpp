// Photons whose middle the view does not show light what it shows.
#include "renderers/methods/ldm-indirect/stages.h"
#include "tests/unit/methods/ldm_indirect_tracing_fixture.h"

namespace ir::test {
namespace {

class IndirectReachTest : public IndirectTracingTest {
  protected:
    /// What is splatted of one bounce, W/m².
    Image irradiance(const Shot& shot, Settings settings) {
        settings.merge(Settings{{"directions", std::int64_t{32}},
                                {"resolution", std::int64_t{100}},
                                {"emission", std::int64_t{24}},
                                {"paths", std::string("indirect")}});
        MethodDescription description;
        description.id = "test";
        for (const auto& part : {li::splatting_outputs(), li::tracing_outputs()})
            description.outputs.insert(description.outputs.end(), part.begin(), part.end());
        const auto table = li::parameter_table();
        const auto method = graph::make_method<li::Parameters>(
            description, table, [](graph::GraphBuilder& builder, const li::Parameters& parameters) {
                const auto scene = passes::upload_scene(builder);
                const auto gbuffer = passes::gbuffer(builder, scene);
                const auto photons = li::trace_photons(builder, scene, gbuffer, parameters);
                li::splat_photons(builder, gbuffer, photons, parameters);
            });
        graph::FrameOptions options;
        options.wanted = {"indirect.irradiance", "gbuffer.position"};
        run_method(method, completed(table.descriptions(), settings), shot.inputs(), options);
        return read("indirect.irradiance");
    }

    static scene::Camera above(glm::vec3 eye, glm::vec3 target, bool orthographic) {
        auto result = camera(eye, target);
        result.up = {0, 0, -1};
        result.orthographic = orthographic;
        result.height = 2;
        result.fov_y = 1.2f;
        return result;
    }
};

/// Of red, without the corners.
double column_mean(const Image& image, int x) {
    double sum = 0;
    for (int y = 8; y < image.height - 8; ++y) sum += image.at(x, y, 0);
    return sum / (image.height - 16);
}

TEST_F(IndirectReachTest, BordersAreAsBrightAsTheSamePlaceInTheMiddle) {
    // The ceiling under a spot lights the floor the same way all around; one picture has the lamp's axis in
    // its middle, the other one at its left border.
    const auto world = planes({spot({0, 0.5f, 0}, {0, 1, 0}, 40)}, glm::vec3(0.7f));
    constexpr int size = 48;
    for (const bool orthographic : {false, true}) {
        const auto half = orthographic ? 1.0f : 1.4f * std::tan(0.6f);
        const Shot centred(world, above({0, 1.4f, 0}, {0, 0, 0}, orthographic), size, size);
        const Shot aside(world, above({half, 1.4f, 0}, {half, 0, 0}, orthographic), size, size);
        for (const bool reject : {false, true}) {
            const Settings rule{{"reject_hidden", reject}};
            const auto middle = irradiance(centred, rule), border = irradiance(aside, rule);
            double worst = 0;
            for (int x = 0; x < size / 2 - 8; ++x)
                worst =
                    std::max(worst, std::abs(column_mean(border, x) / column_mean(middle, x + size / 2) - 1));
            if (reject)
                EXPECT_GT(worst, 0.2) << "the published rule, a mutant here; orthographic " << orthographic;
            else
                EXPECT_LT(worst, 0.02) << "orthographic " << orthographic;
        }
    }
}

TEST_F(IndirectReachTest, BeamsThatLandBesideTheViewLightWhatTheyPass) {
    // A plate between ceiling and floor, by a view of itself and by one that shows the floor, too.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    small.square({0, 3, 0}, {0, -1, 0}, 4);
    small.square({0, 1.4f, 0}, {0, 1, 0}, 0.2f);
    const auto world = with(small.scene(), {spot({0, 1.6f, 0}, {0, 1, 0}, 40)}, glm::vec3(0.7f));
    const auto on_plate = [&](float height, int size) {
        auto slanting = camera({1, 2.4f, 0}, {0, 1.4f, 0});
        slanting.orthographic = true;
        slanting.height = height;
        const auto image = irradiance(Shot(world, slanting, size, size), {});
        double sum = 0;
        for (int y = size / 2 - 3; y < size / 2 + 3; ++y)
            for (int x = size / 2 - 3; x < size / 2 + 3; ++x) sum += image.at(x, y, 0);
        return sum;
    };
    EXPECT_NEAR(on_plate(0.5f, 20) / on_plate(2.5f, 100), 1, 0.02);
}

TEST_F(IndirectReachTest, LightStaysOnItsSideOfAThinWall) {
    // From above: a wall without thickness divides the room, and a spot lights the ceiling far left of it.
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4);
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    small.quad({0, 0, -4}, {0, 0, 4}, {0, 2, 4}, {0, 2, -4});
    const auto world = with(small.scene(), {spot({-2.5f, 0.5f, 0}, {0, 1, 0}, 20)}, glm::vec3(0.7f));
    constexpr int size = 48;
    const Shot shot(world, above({0, 1.4f, 0}, {0, 0, 0}, true), size, size);
    const auto other_side = [&](const Settings& settings) {
        const auto image = irradiance(shot, settings);
        double left = 0, right = 0;
        for (int x = 0; x < size / 2 - 1; ++x) {
            left += column_mean(image, x);
            right += column_mean(image, size - 1 - x);
        }
        return right / left;
    };
    const double published = other_side({{"clipping", std::string("none")}});
    EXPECT_GT(published, 0.02) << "a mutant here";
    for (const std::string way : {"quads", "tiles", "image-atomics"})
        EXPECT_LT(other_side({{"splatting", way}}), 0.1 * published) << way << ", published " << published;
}

TEST_F(IndirectReachTest, FloorBehindTheEyeLightsTheFloorBefore) {
    // Level with the floor's light in its back: photons behind the eye and under it reach what it sees.
    const auto world = planes({spot({0, 0.5f, 0}, {0, 1, 0}, 40)}, glm::vec3(0.7f));
    const Shot from_above(world, above({0, 1.4f, 0}, {0, 0, 0}, false), 48, 48);
    const Shot across(world, camera({0, 0.3f, 0}, {0, 0.1f, -1}), 48, 48);
    for (const std::string way : {"quads", "tiles", "image-atomics"}) {
        const Settings chosen{{"splatting", way}};
        const auto expected = irradiance(from_above, chosen);
        const auto seen = irradiance(across, chosen), position = read("gbuffer.position");
        double worst = 0, checked = 0;
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 48; ++x) {
                const auto at = rgb(position, x, y);
                if (position.at(x, y, 3) == 0 || std::abs(at.y) > 1e-3f ||
                    std::max(std::abs(at.x), std::abs(at.z)) > 0.6f)
                    continue;
                const float scale = 24 / (1.4f * std::tan(0.6f));
                const int column = int(24 + scale * at.x), row = int(24 + scale * at.z);
                worst = std::max(worst, std::abs(double(seen.at(x, y, 0)) / expected.at(column, row, 0) - 1));
                ++checked;
            }
        EXPECT_GT(checked, 50);
        EXPECT_LT(worst, 0.05) << way;
    }
}

}  // namespace
}  // namespace ir::test
