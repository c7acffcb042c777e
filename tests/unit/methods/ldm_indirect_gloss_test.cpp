// What a mirror floor shows of a ceiling that a lamp lights: a closed form. And gloss by either processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <vector>

#include "renderers/methods/all_methods.h"
#include "renderers/passes/scattering/microfacets.h"
#include "tests/unit/methods/extended_light_fixture.h"

namespace ir::test {
namespace {

constexpr float intensity = 3, ceiling_albedo = 0.5f;
constexpr glm::vec3 lamp(0.3f, 1, -0.2f), metal(0.9f, 0.6f, 0.4f), eye(0, 1, 3);

/// Floor and ceiling, 8 m wide, 2 m apart.
scene::Scene hall(float roughness) {
    SmallWorld small;
    small.square({0, 0, 0}, {0, 1, 0}, 4, SmallWorld::masked);
    small.square({0, 2, 0}, {0, -1, 0}, 4);
    auto scene = small.scene();
    auto& mirror = scene.materials[SmallWorld::masked];
    mirror = {};
    mirror.base_colour = glm::vec4(metal, 1);
    mirror.metallic = 1;
    mirror.roughness = roughness;
    auto& plaster = scene.materials[SmallWorld::opaque];
    plaster.base_colour = glm::vec4(glm::vec3(ceiling_albedo), 1);
    plaster.metallic = 0;
    scene::Light light;
    light.position = lamp;
    light.intensity = intensity;
    scene.lights = {light};
    return scene;
}

const graph::Method& ldm_indirect() {
    const auto& all = methods::all_methods();
    return **std::ranges::find_if(all, [](const auto* m) { return m->description.id == "ldm-indirect"; });
}

class LdmIndirectMirror : public PassTest {
  protected:
    Processor body = Processor::host;

    Image look(const Settings& more, const char* key) {
        Settings settings{{"gloss", std::string("mirror")},   {"gloss_tracer", std::string("maps")},
                          {"gloss_samples", std::int64_t{1}}, {"materials", std::string("metalness-blend")},
                          {"paths", std::string("indirect")}, {"directions", std::int64_t{48}},
                          {"resolution", std::int64_t{100}},  {"emission", std::int64_t{4}}};
        for (const auto& [name, value] : more) settings[name] = value;
        auto inputs = shot_.inputs();
        inputs.processor = body;
        graph::FrameOptions options;
        options.wanted = {key, "gbuffer.position", "gbuffer.geometric_normal"};
        report_ = run_method(ldm_indirect(), completed(ldm_indirect().description.parameters, settings),
                             inputs, options);
        return read(key);
    }

    void polish() { shot_ = Shot(hall(0), looking(eye, {0, 0, 0}), 48, 32); }
    static glm::vec3 reflectance(float roughness, float cosine) {
        return roughness > 0 ? passes::directional_albedo(metal, roughness, cosine)
                             : passes::schlick_fresnel(metal, cosine);
    }

    /// Mean of |found - expected| over expected, of pixels that show the floor and the ceiling in it.
    double error(const Settings& more) { return error(look(more, "gloss.radiance"), 0.1f); }
    double error(const Image& found, float roughness) {
        const auto position = read("gbuffer.position"), normal = read("gbuffer.geometric_normal");
        double sum = 0;
        int count = 0;
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x) {
                const glm::vec3 at(position.at(x, y, 0), position.at(x, y, 1), position.at(x, y, 2));
                if (normal.at(x, y, 1) < 0.5f) continue;
                const auto v = glm::normalize(eye - at), l = glm::vec3(-v.x, v.y, -v.z);
                const auto seen = at + 2 / l.y * l;
                if (std::max(std::abs(seen.x), std::abs(seen.z)) > 3.8f) continue;
                const auto to_lamp = lamp - seen;
                const float distance = glm::length(to_lamp);
                const float irradiance = intensity * -to_lamp.y / (distance * distance * distance);
                const auto expected =
                    reflectance(roughness, v.y) * (ceiling_albedo * irradiance / glm::pi<float>());
                for (int c = 0; c < 3; ++c) sum += std::abs(found.at(x, y, c) / expected[c] - 1);
                count += 3;
            }
        EXPECT_GT(count, 900);
        return sum / count;
    }

    std::ptrdiff_t notes(const std::string& text) const {
        return std::ranges::count_if(report_.messages, [&](const Message& message) {
            return message.text.find(text) != std::string::npos;
        });
    }

  private:
    FrameReport report_;
    Shot shot_{hall(0.1f), looking(eye, {0, 0, 0}), 48, 32};
};

// On the plane of what a map's direction hits, the wished direction meets the right place.
TEST_F(LdmIndirectMirror, ShowsTheCeilingWhereItIs) {
    for (const auto processor : {Processor::gl, Processor::host}) {
        body = processor;
        EXPECT_LT(error({{"gloss_tracer", std::string("rays")}}), 1e-3) << to_string(processor);
    }
    EXPECT_LT(error({}), 1e-3);
    const double coarse = error({{"gloss_landing", std::string("direction")}}),
                 fine =
                     error({{"gloss_landing", std::string("direction")}, {"directions", std::int64_t{768}}});
    EXPECT_GT(coarse, 0.05);
    EXPECT_LT(fine, 0.5 * coarse);
}

// A mirror scatters nothing, as in the reference: what it shows of the ceiling is direct light where the
// ceiling reflects the lamp's, and that alone is missing from indirect light.
TEST_F(LdmIndirectMirror, ThatIsSmoothIsNoBounce) {
    polish();
    const auto error_by = [&](const char* tracer) {
        Settings settings{{"gloss", std::string("lobe")},
                          {"gloss_tracer", std::string(tracer)},
                          {"paths", std::string("full")}};
        auto direct = look(settings, "gloss.radiance");
        settings["paths"] = std::string("indirect");
        const auto indirect = look(settings, "gloss.radiance");
        for (std::size_t i = 0; i < direct.pixels.size(); ++i) direct.pixels[i] -= indirect.pixels[i];
        return error(direct, 0);
    };
    EXPECT_LT(error_by("maps"), 1e-3);
    body = Processor::gl;
    EXPECT_LT(error_by("rays"), 1e-3);
}

// A region of 2N is at most 5.5/√(2N) wide, and its direction lies within it. Where that runs below the floor
// another one is taken.
TEST_F(LdmIndirectMirror, AsksTheMapOfANearDirection) {
    for (const std::int64_t directions : {32, 128}) {
        const auto angles = look({{"directions", directions}}, "gloss.error");
        const double widest = glm::degrees(5.5 / std::sqrt(2.0 * double(directions)));
        double sum = 0, most = 0;
        for (const float angle : angles.pixels) sum += angle, most = std::max(most, double(angle));
        EXPECT_GT(sum, 0.05 * widest * double(angles.pixels.size()));
        EXPECT_LT(most, 1.5 * widest) << directions;
    }
    for (const float angle : look({{"gloss_tracer", std::string("rays")}}, "gloss.error").pixels)
        EXPECT_EQ(angle, 0);
}

// Interfaces see surfaces, and no ray meets a lamp without extent.
TEST_F(LdmIndirectMirror, SaysThatDirectPhotonsHaveNoHighlights) {
    const auto count = [&](const char* paths, const char* direct) {
        look({{"paths", std::string(paths)}, {"direct", std::string(direct)}}, "gloss.radiance");
        return notes("direct=photons is diffuse");
    };
    EXPECT_EQ(count("full", "photons"), 1);
    EXPECT_EQ(count("full", "rasterisation"), 0);
    EXPECT_EQ(count("indirect", "photons"), 0);
}

/// Where nothing has an interface the outputs are 0, and they are none where no light is reflected further.
TEST_F(LdmIndirectMirror, OutputsAreThereWhereGlossIs) {
    const auto& description = ldm_indirect().description;
    for (const auto& output : description.outputs) {
        if (!output.key.starts_with("gloss.")) continue;
        const auto is_active_with = [&](const char* key, const char* value) {
            return is_active(description, output,
                             completed(description.parameters, {{key, std::string(value)}}));
        };
        EXPECT_TRUE(is_active_with("paths", "full")) << output.key;
        EXPECT_FALSE(is_active_with("paths", "direct")) << output.key;
        EXPECT_FALSE(is_active_with("gloss", "none")) << output.key;
        ASSERT_TRUE(is_active_with("materials", "lambert")) << output.key;
        for (const float value : look({{"materials", std::string("lambert")}}, output.key.c_str()).pixels)
            ASSERT_EQ(value, 0) << output.key;
    }
}

/// Exact rays draw the same random numbers on either processor.
class LdmIndirectGlossOnBoth : public PassTest {
  protected:
    static scene::Scene room_with_lamps() {
        auto scene = closed_room();
        scene::Light lamp;
        lamp.position = {0.5f, 3, 0.8f};
        lamp.intensity = 4;
        scene.lights.push_back(lamp);
        lamp.type = scene::LightType::spot;
        lamp.position = {-0.5f, 2.5f, 1.2f};
        lamp.direction = glm::normalize(glm::vec3(0.4f, -1, -1));
        scene.lights.push_back(lamp);
        return scene;
    }
    FrameReport render(const Shot& shot, Processor processor, Settings more, int frames = 1,
                       std::vector<std::string> wanted = {"gloss.radiance", "gloss.distance"}) {
        Settings settings{{"directions", std::int64_t{4}},
                          {"resolution", std::int64_t{20}},
                          {"emission", std::int64_t{2}},
                          {"light_samples", std::int64_t{1}}};
        settings.merge(more);
        graph().reset_history();
        FrameReport report;
        for (int frame = 0; frame < frames; ++frame) {
            auto inputs = shot.inputs();
            inputs.processor = processor;
            inputs.frame = frame;
            graph::FrameOptions options;
            options.wanted = wanted;
            report = run_method(ldm_indirect(), completed(ldm_indirect().description.parameters, settings),
                                inputs, options);
        }
        return report;
    }
    void expect_both_agree(const Shot& shot, const Settings& settings, int frames = 1) {
        std::map<std::string, Image> device;
        render(shot, Processor::gl, settings, frames);
        for (const auto* key : {"gloss.radiance", "gloss.distance"}) device[key] = read(key);
        render(shot, Processor::host, settings, frames);
        for (const auto& [key, image] : device) {
            const auto difference = apart(image, read(key));
            EXPECT_LT(difference.part, 0.01) << key;
            EXPECT_NEAR(difference.ratio, 1, 5e-3) << key;
        }
    }
};

// A rough floor sees a shiny ceiling, which has a small and bright highlight of a lamp. Measured on the host.
TEST_F(LdmIndirectGlossOnBoth, HighlightsInHighlightsAreNoDots) {
    auto scene = hall(0.5f);
    auto& ceiling = scene.materials[SmallWorld::opaque];
    ceiling.metallic = 1;
    ceiling.roughness = 0.15f;
    const Shot shot(std::move(scene), looking(eye, {0, 0, 0}), 24, 16);
    const auto picture = [&](double rays, std::int64_t samples) {
        render(shot, Processor::host, {{"gloss_highlight_rays", rays}, {"gloss_samples", samples}});
        return read("gloss.radiance");
    };
    const auto truth = picture(0, 4096);
    const auto light = [&](const Image& image) { return apart(truth, image).ratio; };
    const auto rmse = [&](const Image& image) {
        double sum = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            sum += std::pow(image.pixels[i] - truth.pixels[i], 2);
        return std::sqrt(sum);
    };
    const auto wide = picture(1, 4), as_they_are = picture(0, 4);
    RecordProperty("light", std::to_string(light(wide)));
    RecordProperty("rmse_over_that_of_highlights_as_they_are",
                   std::to_string(rmse(wide) / rmse(as_they_are)));
    EXPECT_NEAR(light(wide), 1, 0.1);
    EXPECT_LT(rmse(wide), 0.5 * rmse(as_they_are));
    EXPECT_NEAR(light(picture(1, 64)), 1, 0.05) << "the more directions, the less they are widened";
}

/// Mirrors scatter nothing, so what they show of a lamp to a rough surface is direct light until the light
/// has been scattered elsewhere. The lamp lights nothing but the mirror.
TEST_F(LdmIndirectGlossOnBoth, SmoothMirrorsShowLampsToRoughSurfacesAsDirectLight) {
    auto scene = hall(0.5f);
    auto& ceiling = scene.materials[SmallWorld::opaque];
    ceiling.metallic = 1;
    ceiling.roughness = 0;
    auto& light = scene.lights.front();
    light.type = scene::LightType::rectangle;
    light.direction = {0, 1, 0};
    light.size = {1, 1};
    const Shot shot(std::move(scene), looking(eye, {0, 0, 0}), 24, 16);
    for (const auto processor : {Processor::gl, Processor::host}) {
        const auto sum = [&](const char* paths, std::int64_t max_bounces) {
            render(shot, processor,
                   {{"gloss_samples", std::int64_t{4}},
                    {"materials", std::string("metalness-blend")},
                    {"max_bounces", max_bounces},
                    {"paths", std::string(paths)}});
            const auto gloss = read("gloss.radiance");
            glm::vec3 result(0);
            for (int y = 0; y < gloss.height; ++y)
                for (int x = 0; x < gloss.width; ++x) result += rgb(gloss, x, y);
            return result.x + result.y + result.z;
        };
        EXPECT_GT(sum("full", 1), 1) << to_string(processor);
        EXPECT_EQ(sum("indirect", 1), 0) << to_string(processor);
        EXPECT_GT(sum("indirect", 2), 0.1) << to_string(processor);
    }
}

/// With all kinds of sources and materials, glass among them, and many bounces.
TEST_F(LdmIndirectGlossOnBoth, SeeTheSame) {
    const Shot shot(room_with_lamps(), looking({0, 1.6f, 1.9f}, {0, 1, -1}), 32, 24);
    expect_both_agree(
        shot, {{"max_bounces", std::int64_t{2}}, {"gloss_samples", std::int64_t{2}}, {"progressive", true}},
        2);
    expect_both_agree(shot, {{"materials", std::string("metalness-blend")},
                             {"gloss", std::string("mirror")},
                             {"gloss_samples", std::int64_t{1}},
                             {"paths", std::string("indirect")}});
}

/// Nor without any light, where programs that sample it are none of the pass's.
TEST_F(LdmIndirectGlossOnBoth, SeeNothingInTheDark) {
    auto scene = room_with_lamps();
    scene.lights.clear();
    scene.environment = {};
    for (auto& material : scene.materials) material.emission = glm::vec3(0);
    scene.materials[2].unlit = true;
    scene.materials[2].base_colour = {0.5f, 0.25f, 1, 1};
    expect_both_agree({std::move(scene), looking({0, 1.6f, 1.9f}, {0, 1, -1}), 40, 32}, {});
}

/// With the device chosen nothing of a picture that point lights light goes over the host but what is made
/// once of the scene.
TEST_F(LdmIndirectGlossOnBoth, NothingOfThePictureIsReadBack) {
    auto scene = closed_room();
    scene.environment = {};
    for (auto& material : scene.materials) material.emission = glm::vec3(0);
    scene::Light lamp;
    lamp.position = {0.5f, 3, 0.8f};
    scene.lights = {lamp};
    const Shot shot(std::move(scene), looking({0, 1.6f, 1.9f}, {0, 1, -1}), 40, 32);
    const auto report = render(shot, Processor::gl, {}, 1, {"radiance"});
    EXPECT_TRUE(std::ranges::any_of(report.passes, [](const auto& pass) {
        return pass.name == "gloss" && pass.queue == "gl" && !pass.culled;
    }));
    for (const auto& pass : report.passes)
        if (pass.queue == "cpu" && !pass.culled) {
            EXPECT_EQ(pass.name, "device BVH");
        }
}

/// Gloss wants the environment as a source, direct light by maps does not, and other sources shine, too.
TEST_F(LdmIndirectGlossOnBoth, TheEnvironmentIsNotSampledForItWhereMapsHaveItsLight) {
    const Shot shot(closed_room(), looking({0, 1.6f, 1.9f}, {0, 1, -1}), 40, 32);
    for (const auto processor : {Processor::gl, Processor::host}) {
        std::vector<Image> direct;
        for (const auto* gloss : {"none", "lobe"}) {
            render(shot, processor, {{"environment_by", std::string("maps")}, {"gloss", std::string(gloss)}},
                   1, {"direct.extended"});
            direct.push_back(read("direct.extended"));
        }
        EXPECT_EQ(direct[0].pixels, direct[1].pixels) << to_string(processor);
    }
}

}  // namespace
}  // namespace ir::test
