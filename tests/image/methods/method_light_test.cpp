// Whether methods have the light that their descriptions say: each kind of source alone in a small room.
#include <gtest/gtest.h>

#include <algorithm>
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

/// Light of valid pixels, without what emits there.
double scattered_light(Experiment e, const MethodDescription& method, const Settings& settings) {
    e.method = method.id;
    e.settings = settings;
    Execution execution(machine(), e);
    graph::FrameOptions options;
    options.wanted = {"valid", "gbuffer.emission"};
    execution.run_frame(options);
    const auto picture = main_result(execution);
    const auto valid = execution.graph().read_image("valid").value(),
               emission = execution.graph().read_image("gbuffer.emission").value();
    const bool is_full = execution.settings().at("paths") == Value{std::string("full")};
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            if (valid.at(x, y) > 0) sum += picture.at(x, y) - (is_full ? emission.at(x, y) : 0.0f);
    return sum / (picture.width * picture.height);
}

std::vector<std::string> paths_of(const MethodDescription& method) {
    std::vector<std::string> result;
    if (const auto* paths = find(method.parameters, "paths")) result = paths->supported;
    std::erase(result, "ao");
    return result;
}

/// Whether there is any light does not depend on numbers of samples.
Settings quick(const MethodDescription& method, const std::string& paths, const Settings& more = {}) {
    return test::with(test::with(test::quick_settings(method), more), {{"paths", paths}});
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
    for (auto& settings : result) settings = quick(method, paths, settings);
    return distinct(result);
}

/// Where a method's direct light is not the reference's, and why.
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
};

/// Light of the method over the reference's: where it lies.
std::pair<double, double> bounds_of(const MethodDescription& method, const Settings& settings,
                                    LightKind kind) {
    for (const auto& each : deviations)
        if (method.id == each.method && kind == each.kind &&
            settings.at(each.setting) == Value{std::string(each.value)})
            return {each.low, each.high};
    return {0.9, 1.1};
}

/// The reference's direct light with the same transport, found once for each.
double true_light(const MethodDescription& method, const Settings& settings, LightKind kind) {
    static std::map<std::pair<LightKind, Settings>, double> found;
    Settings matched{{"samples", std::int64_t{64}}};
    for (const auto& p : method.parameters)
        if (is_transport_key(p.key) && p.key != "max_distance") matched[p.key] = settings.at(p.key);
    auto& light = found[{kind, matched}];
    if (light == 0) light = scattered_light(lit_by(kind), *registry().reference(), matched);
    return light;
}

void expect_described_light(const MethodDescription& method, const Settings& settings, LightKind kind) {
    const auto use = light_use(method, settings);
    const bool expected = use.has(LightPart::direct, kind) || use.has(LightPart::indirect, kind);
    const double found = scattered_light(lit_by(kind), method, settings);
    EXPECT_EQ(found > 1e-4, expected) << method.id << " paths=" << to_string(settings.at("paths")) << ", "
                                      << text_of(kind) << ": " << found;
    if (settings.at("paths") != Value{std::string("direct")} || !use.has(LightPart::direct, kind)) return;
    const auto [low, high] = bounds_of(method, settings, kind);
    const double ratio = found / true_light(method, settings, kind);
    EXPECT_TRUE(low < ratio && ratio < high)
        << method.id << ", " << text_of(kind) << ": " << ratio << " of the reference's direct light";
}

TEST(MethodLight, IsWhatTheDescriptionSays) {
    int judged = 0;
    for (const auto* method : registry().methods())
        for (const auto& paths : paths_of(*method))
            for (const auto& settings : variants_of(*method, paths))
                for (const auto kind :
                     {LightKind::punctual, LightKind::lamp, LightKind::surface, LightKind::environment}) {
                    expect_described_light(*method, settings, kind);
                    ++judged;
                }
    EXPECT_GE(judged, 60);
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
            e.settings = quick(*method, "full");
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
