// Whether methods have the light that their descriptions say: each kind of source alone in a small room.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/engine/execution.h"
#include "app/engine/pictures.h"
#include "renderers/core/light_use.h"
#include "renderers/core/transport.h"
#include "tests/image/methods/every_method.h"
#include "tests/image/methods/machine.h"
#include "tests/light_variants.h"

namespace ir::engine {
namespace {

constexpr float shown_radiance = 50;  ///< of what faces the camera, W/(m² sr); nothing else is as bright

scene::Light lamp_of(scene::LightType type) {
    scene::Light result;
    result.type = type;
    result.position = {0, 0.5f, -0.25f};
    result.direction = {0, 0, -1};  // at the back wall: the camera sees its dark side
    result.intensity = type == scene::LightType::rectangle ? 10.0f : 1.0f;
    result.size = {0.1f, 0.1f};
    return result;
}

/// The Cornell box with one source: in full pictures it is not in sight.
Experiment lit_by(LightKind kind) {
    Experiment e;
    e.scene = kind == LightKind::surface ? "builtin:cornell?light=0" : "builtin:cornell?emission=0";
    e.replace_lights = true;
    if (kind == LightKind::punctual) e.lights = {lamp_of(scene::LightType::point)};
    if (kind == LightKind::lamp) e.lights = {lamp_of(scene::LightType::rectangle)};
    if (kind == LightKind::environment) e.environment = scene::Environment{glm::vec3(1), nullptr};
    e.width = 24, e.height = 24;
    return e;
}

/// Mean of red over the picture, and the standard error that samples leave.
struct Light {
    double value = 0, error = 0;
};

/// Of valid pixels of an output (empty: the main result), without what emits there.
Light scattered_light(Experiment e, const MethodDescription& method, const Settings& settings,
                      const std::string& output = "") {
    e.method = method.id;
    e.settings = settings;
    Execution execution(machine(), e);
    const auto& graph = execution.graph();
    const char* noise = method.is_reference ? "reference.variance" : "direct.extended.variance";
    graph::FrameOptions options;
    options.wanted = {"valid", "gbuffer.emission", noise, output};
    execution.run_frame(options);
    const auto picture = output.empty() ? main_result(execution) : graph.read_image(output).value();
    const auto valid = graph.read_image("valid").value(),
               emission = graph.read_image("gbuffer.emission").value();
    const auto variance = graph.read_image(noise);
    const auto paths = execution.settings().find("paths");
    const bool has_emission = output == lit_output_key || (paths != execution.settings().end() &&
                                                           paths->second == Value{std::string("full")});
    double sum = 0, squares = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            if (valid.at(x, y) == 0) continue;
            sum += picture.at(x, y) - (has_emission ? emission.at(x, y) : 0.0f);
            if (variance) squares += variance->at(x, y);
        }
    const double pixels = picture.width * picture.height;
    return {sum / pixels, std::sqrt(squares) / pixels};
}

std::vector<std::string> paths_of(const MethodDescription& method) {
    std::vector<std::string> result;
    if (const auto* paths = find(method.parameters, "paths")) result = paths->supported;
    std::erase(result, "ao");
    return result;
}

/// Whether there is any light does not depend on numbers of samples, but how well it is known does.
Settings quick(const MethodDescription& method, const Settings& more = {}) {
    auto settings = test::quick_settings(method);
    if (settings.count("light_samples")) settings["light_samples"] = std::int64_t{64};
    if (method.is_reference) settings["samples"] = std::int64_t{128};
    return test::with(settings, more);
}

std::vector<Settings> distinct(const std::vector<Settings>& all) {
    std::vector<Settings> result;
    for (const auto& each : all)
        if (std::ranges::count(result, each) == 0) result.push_back(each);
    return result;
}

/// Of these paths: the defaults, and what changes which light the method has.
std::vector<Settings> variants_of(const MethodDescription& method, const std::string& paths) {
    auto result = test::light_variants(method);
    for (auto& settings : result) settings = test::with(quick(method, settings), {{"paths", paths}});
    return distinct(result);
}

/// Where a method's direct light is not the reference's but for noise, and why.
struct Deviation {
    const char* method;
    const char* setting;
    const char* value;
    LightKind kind;
    double low, high;
};
const Deviation deviations[] = {
    // Nothing beyond a step of 1 m keeps the environment out of the box.
    {"ssdo", "environment_by", "occlusion", LightKind::environment, 2, 4},
    // Maps of 32 directions, each with one light for all of its region.
    {"ldm-indirect", "environment_by", "maps", LightKind::environment, 0.97, 1.04},
};

const Deviation* deviation_of(const MethodDescription& method, const Settings& settings, LightKind kind) {
    for (const auto& each : deviations)
        if (method.id == each.method && kind == each.kind &&
            settings.at(each.setting) == Value{std::string(each.value)})
            return &each;
    return nullptr;
}

/// The reference's direct light with the same transport, found once for each.
Light true_light(const MethodDescription& method, const Settings& settings, LightKind kind) {
    static std::map<std::pair<LightKind, Settings>, Light> found;
    Settings matched{{"samples", std::int64_t{256}}};
    for (const auto& p : method.parameters)
        if (is_transport_key(p.key) && p.key != "max_distance" && p.key != "falloff")
            matched[p.key] = settings.at(p.key);
    matched["paths"] = std::string("direct");
    auto& light = found[{kind, matched}];
    if (light.value == 0) light = scattered_light(lit_by(kind), *registry().reference(), matched);
    return light;
}

void expect_equal_but_for_noise(const Light& found, const MethodDescription& method, const Settings& settings,
                                LightKind kind) {
    const auto truth = true_light(method, settings, kind);
    const double ratio = found.value / truth.value;
    if (const auto* known = deviation_of(method, settings, kind)) {
        EXPECT_TRUE(known->low < ratio && ratio < known->high)
            << method.id << ", " << text_of(kind) << ": " << ratio << " of the reference's direct light";
        return;
    }
    const double noise = std::hypot(found.error, truth.error) / truth.value;
    EXPECT_LT(noise, 0.006) << method.id << ", " << text_of(kind);
    EXPECT_NEAR(ratio, 1, 4 * noise + 2e-3) << method.id << ", " << text_of(kind);
}

void expect_described_light(const MethodDescription& method, const Settings& settings, LightKind kind) {
    const auto use = light_use(method, settings);
    const bool expected = use.has(LightPart::direct, kind) || use.has(LightPart::indirect, kind);
    const auto found = scattered_light(lit_by(kind), method, settings);
    EXPECT_EQ(found.value > 1e-4, expected) << method.id << " paths=" << to_string(settings.at("paths"))
                                            << ", " << text_of(kind) << ": " << found.value;
    if (settings.at("paths") == Value{std::string("direct")} && use.has(LightPart::direct, kind))
        expect_equal_but_for_noise(found, method, settings, kind);
}

constexpr LightKind all_kinds[] = {LightKind::punctual, LightKind::lamp, LightKind::surface,
                                   LightKind::environment};

TEST(MethodLight, IsWhatTheDescriptionSays) {
    int judged = 0;
    for (const auto* method : registry().methods())
        for (const auto& paths : paths_of(*method))
            for (const auto& settings : variants_of(*method, paths))
                for (const auto kind : all_kinds) {
                    expect_described_light(*method, settings, kind);
                    ++judged;
                }
    EXPECT_GE(judged, 60);
}

/// Methods of ambient occlusion have it in the output "lit", beside light from everywhere, which is off here.
TEST(MethodLight, OfLitIsTheReferencesDirectLight) {
    int judged = 0;
    for (const auto* method : registry().methods()) {
        if (std::ranges::find(method->outputs, lit_output_key, &OutputDescription::key) ==
            method->outputs.end())
            continue;
        const auto settings = quick(*method, {{"ambient", 0.0}});
        const auto use = light_use_of_lit(*method, settings);
        for (const auto kind : all_kinds) {
            const auto found = scattered_light(lit_by(kind), *method, settings, lit_output_key);
            const bool is_lit = use.has(LightPart::direct, kind);
            EXPECT_EQ(found.value > 1e-4, is_lit)
                << method->id << ", " << text_of(kind) << ": " << found.value;
            if (!is_lit) continue;
            expect_equal_but_for_noise(found, *method, settings, kind);
            ++judged;
        }
    }
    EXPECT_EQ(judged, 12) << "three kinds of sources for each of four methods";
}

/// A rectangle in front of the back wall that shines at the camera.
TEST(MethodLight, LampsAreSeenWhereTheDescriptionSays) {
    auto e = lit_by(LightKind::lamp);
    e.lights[0].position = {0, 0.3f, -0.2f};
    e.lights[0].direction = {0, 0, 1};
    e.lights[0].intensity = shown_radiance;
    for (const auto* method : registry().methods()) {
        if (paths_of(*method).empty()) continue;
        e.method = method->id;
        for (const char* emitters : {"all", "none"}) {
            e.settings = quick(*method, {{"paths", std::string("full")}});
            if (e.settings.count("emitters")) e.settings["emitters"] = emitters;
            Execution execution(machine(), e);
            execution.run_frame({});
            const auto picture = main_result(execution);
            const float brightest = *std::max_element(picture.pixels.begin(), picture.pixels.end());
            EXPECT_EQ(brightest > 0.9f * shown_radiance,
                      light_use(*method, e.settings).has(LightPart::seen, LightKind::lamp))
                << method->id << " " << brightest;
        }
    }
}

}  // namespace
}  // namespace ir::engine
