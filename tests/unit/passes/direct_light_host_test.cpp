// Direct light of lights without extent, on the host by rays and on the device by shadow maps.
#include "renderers/passes/direct/direct_light.h"

#include <cmath>

#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

using Materials = Transport::Materials;

class DirectLightOnHost : public PassTest {
  protected:
    Processor processor() const override { return processor_; }
    std::vector<OutputDescription> outputs() const override { return {passes::direct_output()}; }

    Image radiance(const Shot& shot, Processor processor, Materials materials, int threads = 0) {
        processor_ = processor;
        graph().reset_history();
        auto inputs = shot.inputs();
        inputs.processor = processor;
        inputs.threads = threads;
        const auto report = run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            passes::direct_light(builder, scene, passes::gbuffer(builder, scene),
                                 {.extended = {.parameters = {.light_samples = 0}, .materials = materials}});
        });
        EXPECT_EQ(ran_on_host(report, "direct light"), processor == Processor::host);
        return read("direct.radiance");
    }

    Processor processor_ = Processor::gl;
};

/// A point, a spot and a directional light; textures, alpha masks, glass, mirrors and unlit surfaces.
Shot three_lights(const char* name) {
    auto scene = scene::load_scene(name);
    const auto bounds = scene::bounds_of(scene, 0);
    scene::Light light;
    light.position = bounds.centre() + glm::vec3(0, 0.2f, 0) * (bounds.max - bounds.min);
    light.direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f));
    light.intensity = 5;
    scene.lights.assign(3, light);
    scene.lights[1].type = scene::LightType::spot;
    scene.lights[2].type = scene::LightType::directional;
    scene.materials.at(0).roughness = 0;
    scene.materials.at(1).unlit = true;
    return {scene, scene.cameras.at(0), 96, 64};
}

TEST_F(DirectLightOnHost, IsTheDevicesButAtTheEdgesOfShadows) {
    for (const char* name : {"builtin:still-life", "builtin:atrium"}) {
        const auto shot = three_lights(name);
        for (const auto materials : {Materials::gltf, Materials::metalness_blend, Materials::lambert}) {
            const auto drawn = radiance(shot, Processor::gl, materials),
                       traced = radiance(shot, Processor::host, materials);
            int differ = 0, lit = 0;
            double mean_drawn = 0, mean_traced = 0;
            for (std::size_t i = 0; i < drawn.pixels.size(); i += 4) {
                const glm::vec3 a(drawn.pixels[i], drawn.pixels[i + 1], drawn.pixels[i + 2]);
                const glm::vec3 b(traced.pixels[i], traced.pixels[i + 1], traced.pixels[i + 2]);
                const float size = std::max(glm::length(a), glm::length(b));
                lit += size > 0;
                mean_drawn += glm::length(a), mean_traced += glm::length(b);
                differ += glm::distance(a, b) > 0.1f * size;
            }
            // Of the atrium's small picture many pixels lie at edges, where the G-buffer's bodies differ,
            // too.
            const auto what =
                std::string(name) + ", materials " + std::to_string(static_cast<int>(materials));
            EXPECT_GT(lit, 2000) << what;
            EXPECT_LT(differ, 0.1 * lit) << what;
            EXPECT_NEAR(mean_traced / mean_drawn, 1, 0.02) << what;
        }
    }
}

TEST_F(DirectLightOnHost, DoesNotDependOnThreads) {
    const auto shot = three_lights("builtin:still-life");
    const auto one = radiance(shot, Processor::host, Materials::gltf, 1),
               many = radiance(shot, Processor::host, Materials::gltf, 4);
    EXPECT_EQ(one.pixels, many.pixels);
}

}  // namespace
}  // namespace ir::test
