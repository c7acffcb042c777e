// What depth peeling adds to screen-space directional occlusion, against closed forms.
#include <cmath>
#include <numbers>

#include "tests/unit/methods/ssdo_fixture.h"

namespace ir::test {
namespace {

/// The six sides of a box, outwards.
void add_box(SmallWorld& world, glm::vec3 low, glm::vec3 high) {
    const auto corner = [&](int x, int y, int z) {
        return glm::vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    world.quad(corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1));
    world.quad(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
    world.quad(corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0));
    world.quad(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    world.quad(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
    world.quad(corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0));
}

constexpr float half = 0.3125f;  ///< of the slab's side: whole pixels of the picture from above
constexpr glm::vec3 slab_low{-half, 0.3f, -half}, slab_high{half, 0.4f, half};

scene::Scene slab_above_floor() {
    SmallWorld world;
    world.square({0, 0, 0}, {0, 1, 0}, 4);
    add_box(world, slab_low, slab_high);
    auto scene = world.scene();
    scene.lights = lit_wall().lights;
    return scene;
}

/// Cosine-weighted fraction of the steps of up to 1 m from a point of the floor that end in a box: the
/// integral of cosθ / (π s²) over its part within the ball.
double ends_within(glm::dvec3 low, glm::dvec3 high, glm::dvec3 from) {
    constexpr int n = 60;
    const auto cell = (high - low) / double(n);
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const auto way = low + cell * (glm::dvec3(i, j, k) + 0.5) - from;
                const double s2 = glm::dot(way, way);
                if (s2 < 1) sum += way.y / (s2 * std::sqrt(s2));
            }
    return sum * cell.x * cell.y * cell.z / std::numbers::pi;
}

class SsdoLayersTest : public SsdoTest {
  protected:
    /// Of the slab from above.
    Image peeled(Processor processor, int layers, const std::string& key) {
        body = processor;
        const Shot shot(slab_above_floor(), looking({0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 2), 32, 32);
        auto settings = many_samples(512, 1);
        settings["layers"] = std::int64_t{layers};
        return render(shot, settings, key);
    }
};

TEST_F(SsdoLayersTest, TheSecondLayerEndsABody) {
    for (const auto processor : {Processor::gl, Processor::host}) {
        const auto open = peeled(processor, 2, "ssdo.accessibility");
        const auto at = rgb(read("gbuffer.position"), 9, 16);
        ASSERT_NEAR(at.y, 0, 1e-5);
        ASSERT_LT(at.x, -half);
        EXPECT_NEAR(1 - open.at(9, 16), ends_within(slab_low, slab_high, at), 0.01);
        const auto one = peeled(processor, 1, "ssdo.accessibility");
        const glm::vec3 floor_below(slab_low.x, 0, slab_low.z);
        EXPECT_NEAR(1 - one.at(9, 16), ends_within(floor_below, slab_high, at), 0.01);
        EXPECT_GT(open.at(9, 16) - one.at(9, 16), 0.03);
    }
}

TEST_F(SsdoLayersTest, LayersAreTheSurfacesBehindEachOtherAndNormalsTheirFronts) {
    for (const auto processor : {Processor::gl, Processor::host}) {
        const auto position = peeled(processor, 3, "ssdo.hidden.positions");
        const auto normal = read("ssdo.hidden.normals");
        for (int x = 0; x < 32; ++x) {
            const bool is_slab = std::abs(x - 15.5f) < half * 16;
            EXPECT_EQ(position.at(x, 16, 3) > 0, is_slab) << x;
            if (!is_slab) continue;
            EXPECT_NEAR(position.at(x, 16, 1), slab_low.y, 1e-5);
            EXPECT_NEAR(normal.at(x, 16, 1), -1, 1e-5) << "a body is left";
        }
        const auto floor = read("gbuffer.position.3"), floor_normal = read("gbuffer.geometric_normal.3");
        EXPECT_NEAR(floor.at(16, 16, 1), 0, 1e-5);
        EXPECT_NEAR(floor_normal.at(16, 16, 1), 1, 1e-5);
    }
}

/// The sun shines in below from the side. Behind the front of a sheet, as far as the next layer, is a body.
TEST_F(SsdoLayersTest, FrontsSendLightOnlyWhereTheyFaceAnOpening) {
    const auto below_the_slab = [&] {
        peeled(Processor::host, 3, "ssdo.accessibility");
        return read("ssdo.hidden.senders", 1).at(19, 16);
    };
    const auto below_a_sheet = [&] {
        SmallWorld world;
        world.square({0, 0, 0}, {0, 1, 0}, 4);
        world.square({0, slab_high.y, 0}, {0, 1, 0}, half);
        auto scene = world.scene();
        scene.lights = lit_wall().lights;
        const Shot shot(scene, looking({0, 5, 0}, {0, 0, 0}, {0, 0, -1}, 2), 32, 32);
        auto settings = many_samples(16, 1);
        settings["layers"] = std::int64_t{3};
        render(shot, settings);
        EXPECT_GT(read("direct.radiance.2").at(19, 16), 0.1f) << "it is lit";
        return read("ssdo.hidden.senders", 0).at(19, 16);
    };
    EXPECT_GT(below_the_slab(), 0.1f);
    EXPECT_EQ(below_a_sheet(), 0);
}

/// The camera sees the dark side of a wall from behind, and the floor beyond it, which the lit side lights.
TEST_F(SsdoLayersTest, SidesThatTheCameraDoesNotSeeSendTheirLight) {
    SmallWorld world;
    world.quad({0, 0, 1}, {2, 0, 1}, {2, 0, -1}, {0, 0, -1});
    add_box(world, {-0.1f, 0, -0.5f}, {0, 1, 0.5f});
    auto scene = world.scene();
    for (auto& material : scene.materials) material.base_colour = {0.8f, 0.8f, 0.8f, 1};
    scene.lights = lit_wall().lights;
    const double wall = 0.8 / std::numbers::pi * 3 * std::sqrt(0.5);
    for (const auto processor : {Processor::gl, Processor::host})
        for (const int layers : {1, 2}) {
            body = processor;
            const Shot shot(scene, looking({-2, 5, 0.3f}, {0.6f, 0.3f, 0}), 48, 48);
            auto settings = many_samples(128, 0);
            settings["layers"] = std::int64_t{layers};
            const auto indirect = render(shot, settings);
            const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
            double sum = 0, expected = 0;
            int n = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x) {
                    const double from_wall = position.at(x, y, 0);
                    if (normal.at(x, y, 1) < 0.9f || from_wall < 0.05) continue;
                    sum += indirect.at(x, y, 0);
                    expected += 0.8 * wall * wall_form_factor(from_wall, position.at(x, y, 2), 1e9);
                    ++n;
                }
            ASSERT_GT(n, 250);
            if (layers == 1)
                EXPECT_LT(sum, 0.01 * expected);
            else
                EXPECT_NEAR(sum / expected, 1, 0.05);
        }
}

}  // namespace
}  // namespace ir::test
