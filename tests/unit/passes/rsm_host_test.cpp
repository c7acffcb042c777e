// What rays find on the host's threads is what light images show when they are drawn, but at edges.
#include "renderers/passes/rsm/rsm.h"

#include <cmath>

#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

constexpr int rsm_size = 64;

class RsmOnHost : public PassTest {
  protected:
    Processor processor() const override { return processor_; }
    std::vector<OutputDescription> outputs() const override { return passes::rsm_outputs({}, true); }

    struct Layer {
        Image albedo, normal, geometric_normal, depth;
    };
    std::vector<Layer> layers(const Shot& shot, bool exact_albedo, Processor processor) {
        processor_ = processor;
        graph().reset_history();
        const auto views = passes::shadow_views(shot.world, rsm_size);
        const auto report = run(shot, [&](graph::GraphBuilder& builder) {
            passes::draw_rsm(builder, passes::upload_scene(builder),
                             {.views = views,
                              .resolution = rsm_size,
                              .geometric_normal = true,
                              .may_be_traced = true,
                              .exact_albedo = exact_albedo});
        });
        EXPECT_EQ(ran_on_host(report, "RSM"), processor == Processor::host);
        std::vector<Layer> result;
        for (int i = 0; i < static_cast<int>(views.size()); ++i)
            result.push_back({read("rsm.albedo_roughness", i), read("rsm.normal_metalness", i),
                              read("rsm.geometric_normal", i), read("rsm.depth", i)});
        return result;
    }

    static double mean_difference(const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
        return sum / static_cast<double>(a.pixels.size());
    }

    Processor processor_ = Processor::gl;
};

/// A point, a spot and a directional light, with textures, alpha masks and glass.
TEST_F(RsmOnHost, ShowsWhatIsDrawn) {
    for (const char* name : {"builtin:still-life", "builtin:atrium"}) {
        auto scene = scene::load_scene(name);
        const auto middle = scene::bounds_of(scene, 0).centre();
        scene::Light light;
        light.position = middle;
        light.direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f));
        scene.lights.assign(3, light);
        scene.lights[1].type = scene::LightType::spot;
        scene.lights[2].type = scene::LightType::directional;
        const Shot shot(scene, scene.cameras.at(0), 8, 8);
        for (const bool exact : {false, true}) {
            const auto drawn = layers(shot, exact, Processor::gl),
                       found = layers(shot, exact, Processor::host);
            ASSERT_EQ(drawn.size(), 8u);
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                EXPECT_LT(mean_difference(drawn[i].depth, found[i].depth), 5e-3) << name << ' ' << i;
                EXPECT_LT(mean_difference(drawn[i].albedo, found[i].albedo), 0.01) << name << ' ' << i;
                EXPECT_LT(mean_difference(drawn[i].normal, found[i].normal), 0.02) << name << ' ' << i;
                EXPECT_LT(mean_difference(drawn[i].geometric_normal, found[i].geometric_normal), 0.02)
                    << name << ' ' << i;
            }
        }
    }
}

/// A wide spot and a point light at one place see the same in the spot's cone, and outside it there is
/// nothing.
TEST_F(RsmOnHost, OutsideASpotsConeTheMapIsEmpty) {
    auto scene = scene::load_scene("builtin:still-life");
    scene::Light light;
    light.position = scene::bounds_of(scene, 0).centre();
    light.direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
    scene.lights.assign(2, light);
    scene.lights[0].type = scene::LightType::spot;
    scene.lights[0].outer_angle = 1.3f;
    const Shot shot(scene, scene.cameras.at(0), 8, 8);
    const auto views = passes::shadow_views(shot.world, rsm_size);
    ASSERT_EQ(views.size(), 12u);
    for (const auto processor : {Processor::gl, Processor::host}) {
        const auto maps = layers(shot, false, processor);
        int inside = 0;
        for (std::size_t face = 0; face < 6; ++face)
            for (int y = 0; y < rsm_size; ++y)
                for (int x = 0; x < rsm_size; ++x) {
                    const auto ndc = (glm::vec2(x, y) + 0.5f) / (0.5f * rsm_size) - 1.0f;
                    const auto& view = views[face];
                    const auto direction = view.forward_ws + ndc.x * view.right_ws - ndc.y * view.up_ws;
                    const float cosine = glm::dot(glm::normalize(direction), scene.lights[0].direction),
                                beyond = cosine - std::cos(scene.lights[0].outer_angle);
                    if (std::abs(beyond) < 1e-5f) continue;
                    const auto &spot = maps[face], &point = maps[face + 6];
                    inside += beyond > 0;
                    ASSERT_EQ(spot.depth.at(x, y), beyond > 0 ? point.depth.at(x, y) : 1) << face;
                    ASSERT_EQ(spot.normal.at(x, y, 3), beyond > 0 ? point.normal.at(x, y, 3) : 0) << face;
                }
        EXPECT_GT(inside, rsm_size * rsm_size);
    }
}

}  // namespace
}  // namespace ir::test
