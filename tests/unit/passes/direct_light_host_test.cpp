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

    /// What is lit, and the surfaces that it lies on.
    struct Lit {
        Image radiance, position, normal;
    };

    Lit lit(const Shot& shot, Processor processor, Materials materials) {
        auto image = radiance(shot, processor, materials);
        return {std::move(image), read("gbuffer.position"), read("gbuffer.normal")};
    }

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
    // What is left lies along edges of shadows: 0.3 and 3 %.
    for (const auto& [name, part] : {std::pair{"builtin:still-life", 0.006}, {"builtin:atrium", 0.05}}) {
        const auto shot = three_lights(name);
        for (const auto materials : {Materials::gltf, Materials::metalness_blend, Materials::lambert}) {
            const auto drawn = lit(shot, Processor::gl, materials),
                       traced = lit(shot, Processor::host, materials);
            const auto rgb = [](const Image& image, std::size_t i) {
                const auto at = i * static_cast<std::size_t>(image.channels);
                return glm::vec3(image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]);
            };
            int differ = 0, lit = 0;
            double mean_drawn = 0, mean_traced = 0;
            const auto pixels = static_cast<std::size_t>(drawn.radiance.width) * drawn.radiance.height;
            for (std::size_t i = 0; i < pixels; ++i) {
                const auto a = rgb(drawn.radiance, i), b = rgb(traced.radiance, i);
                mean_drawn += glm::length(a), mean_traced += glm::length(b);
                // The two G-buffers show other surfaces along edges.
                if (glm::distance(rgb(drawn.position, i), rgb(traced.position, i)) > 1e-3f ||
                    glm::distance(rgb(drawn.normal, i), rgb(traced.normal, i)) > 1e-2f)
                    continue;
                const float size = std::max(glm::length(a), glm::length(b));
                lit += size > 0;
                differ += glm::distance(a, b) > 0.05f * size;
            }
            const auto what =
                std::string(name) + ", materials " + std::to_string(static_cast<int>(materials));
            EXPECT_GT(lit, 2000) << what;
            EXPECT_LT(differ, part * lit) << what;
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
