// Direct light of lights without extent, on the host by rays and on the device by shadow maps.
#include "renderers/passes/direct/direct_light.h"

#include <cmath>

#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

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

/// Light falls along the normal of a pane on the middle of a floor.
TEST_F(DirectLightOnHost, SheetsOfClearGlassLetLightPassAsLightSamplesDo) {
    enum class Between { nothing, clear, two, rough, thick, wall_behind };
    const glm::vec3 tint(0.9f, 0.6f, 0.3f);
    constexpr auto glass = static_cast<SmallWorld::Material>(2);
    const auto floor_below = [&](Between between, scene::LightType type) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 1, 0}, 2);
        if (between != Between::nothing) small.square({0, 1, 0}, {0, 1, 0}, 0.3f, glass);
        if (between == Between::two) small.square({0, 1.2f, 0}, {0, -1, 0}, 0.3f, glass);
        if (between == Between::wall_behind) small.square({0, 1.5f, 0}, {0, 1, 0}, 0.2f);
        auto scene = small.scene();
        scene.materials.resize(3);
        for (auto& material : scene.materials) material.metallic = 0;
        auto& pane = scene.materials[glass];
        pane.base_colour = glm::vec4(tint, 1);
        pane.transmission = 1;
        pane.roughness = between == Between::rough ? 0.5f : 0;
        pane.thickness = between == Between::thick ? 0.1f : 0;
        scene::Light light;
        light.type = type;
        light.position = {0, 2.5f, 0};
        light.direction = {0, -1, 0};
        light.intensity = 5;
        scene.lights = {light};
        return Shot(std::move(scene), looking({0, 0.5f, 3}, {0, 0, 0}), 17, 17);
    };
    const float interface = 0.04f;
    const auto once = tint * (1 - 2 * interface / (1 + interface));
    for (const auto type : {scene::LightType::point, scene::LightType::spot, scene::LightType::directional})
        for (const auto processor : {Processor::gl, Processor::host}) {
            const auto middle = [&](Between between, Materials materials = Materials::gltf) {
                const auto image = radiance(floor_below(between, type), processor, materials);
                return glm::vec3(image.at(8, 8, 0), image.at(8, 8, 1), image.at(8, 8, 2));
            };
            const auto open = middle(Between::nothing);
            const auto expect = [&](Between between, glm::vec3 part) {
                const auto found = middle(between) / open;
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found[c], part[c], 2e-3) << static_cast<int>(between) << ", light "
                                                         << static_cast<int>(type) << to_string(processor);
            };
            ASSERT_GT(open.r, 0);
            expect(Between::clear, once);
            expect(Between::two, once * once);
            expect(Between::rough, glm::vec3(0));
            expect(Between::thick, glm::vec3(0));
            expect(Between::wall_behind, glm::vec3(0));
            EXPECT_EQ(middle(Between::clear, Materials::lambert), glm::vec3(0));
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
