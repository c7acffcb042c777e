#include "renderers/methods/all_methods.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

class PhotonCulling : public PassTest {
  protected:
    Image irradiance(const Shot& shot, Settings settings, FrameReport& report) {
        settings["photons"] = std::int64_t{4000};
        settings["rsm_resolution"] = std::string("64");
        settings["max_bounces"] = std::int64_t{2};
        const auto& all = methods::all_methods();
        const auto& method = **std::find_if(
            all.begin(), all.end(), [](const auto* m) { return m->description.id == "photon-mapping"; });
        graph::FrameOptions options;
        options.wanted = {"splat.irradiance", "photons.tally"};
        report =
            graph().run(method, completed(method.description.parameters, settings), shot.inputs(), options);
        return read("splat.irradiance");
    }
    static Shot lit_box(const scene::Camera& camera) {
        auto scene = scene::load_scene("builtin:cornell");
        scene::Light light;
        light.position = scene::bounds_of(scene, 0).centre();
        light.intensity = 10;
        scene.lights = {light};
        return {scene, camera, 50, 42};
    }
};

TEST_F(PhotonCulling, LeavesThePictureAsItIs) {
    const auto box = scene::load_scene("builtin:cornell");
    auto close = box.cameras[0];  // half of the box lies behind the camera
    close.eye = scene::bounds_of(box, 0).centre();
    close.target = close.eye + glm::vec3(0.3f, 0.2f, -1);
    auto parallel = box.cameras[0];
    parallel.orthographic = true;
    parallel.height = 0.5f * scene::bounds_of(box, 0).radius();
    for (const auto& camera : {box.cameras[0], close, parallel})
        for (const char* resolution : {"full", "quarter"}) {
            const auto shot = lit_box(camera);
            FrameReport all, culled;
            const Settings settings{{"splat_resolution", std::string(resolution)}};
            auto without = settings;
            without["culling"] = false;
            const auto expected = irradiance(shot, without, all), found = irradiance(shot, settings, culled);
            double sum = 0, worst = 0;
            for (int y = 0; y < expected.height; ++y)
                for (int x = 0; x < expected.width; ++x) {
                    sum += expected.at(x, y, 0);
                    worst = std::max(worst, double(std::abs(expected.at(x, y, 0) - found.at(x, y, 0))));
                }
            EXPECT_GT(sum, 0) << resolution << (camera.orthographic ? " parallel" : " perspective");
            EXPECT_EQ(worst, 0) << resolution;
            EXPECT_GT(culled.counters.at("photons.culled"), 100) << resolution;
            EXPECT_EQ(culled.counters.at("photons.culled") + culled.counters.at("photons.count"),
                      all.counters.at("photons.count"));
        }
}

}  // namespace
}  // namespace ir::test
