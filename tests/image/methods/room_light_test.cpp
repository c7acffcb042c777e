// Light of whole rooms at the defaults of the methods that reflect it further, over the reference's of the
// same transport: from lights without and with an extent, emissive meshes and the environment.
#include <cstdlib>
#include <filesystem>

#include "renderers/core/transport.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

struct Interval {
    double low, high;
};

struct Room {
    std::string name, scene;
    std::optional<std::vector<scene::Light>> lights = {};  ///< in place of the scene's
    std::optional<glm::vec3> environment = {};
    std::string opaque = {};  ///< material of glass that is to let no light through
    Interval photons{0.95, 1.05}, maps{0.95, 1.05}, discs{0.85, 1.1};
    int samples = 128;
};

std::ostream& operator<<(std::ostream& out, const Room& room) {
    return out << room.name;
}

constexpr int size = 64;

const MethodDescription& description_of(const std::string& id) {
    for (const auto* method : methods::all_methods())
        if (method->description.id == id) return method->description;
    throw std::logic_error("no method " + id);
}

/// Luminance of what valid pixels scatter, summed over the picture: without what emits.
double scattered_light(const Room& room, const std::string& method, const Settings& settings, int frames) {
    engine::Experiment experiment;
    scene::Part part{room.scene};
    if (!room.opaque.empty()) part.materials[room.opaque].transmission = 0;
    experiment.parts = {part};
    experiment.scene = scene::composition_name(experiment.parts);
    experiment.method = method;
    experiment.settings = settings;
    if (room.lights) {
        experiment.lights = *room.lights;
        experiment.replace_lights = true;
    }
    if (room.environment) experiment.environment = scene::Environment{*room.environment, nullptr};
    experiment.width = experiment.height = size;
    experiment.seed = 3;
    engine::Execution execution(machine(), experiment);
    graph::FrameOptions options;
    options.wanted = {"valid", "gbuffer.emission"};
    for (int i = 0; i < frames; ++i) execution.run_frame(options);
    const auto picture = main_result(execution);
    const auto valid = execution.graph().read_image("valid").value(),
               emission = execution.graph().read_image("gbuffer.emission").value();
    constexpr double weights[] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c)
                if (valid.at(x, y) > 0.5f)
                    sum += weights[c] * double(picture.at(x, y, c) - emission.at(x, y, c));
    return sum;
}

/// The method's light over that of its matched reference, which is found once for each transport.
double light_ratio(const Room& room, const std::string& id, const Settings& more, int frames) {
    static std::map<std::pair<std::string, Settings>, double> truths;
    const auto& method = description_of(id);
    const auto settings = with(defaults(method.parameters), more);
    Settings matched{{"samples", std::int64_t{room.samples}}};
    for (const auto& p : method.parameters)
        if (is_transport_key(p.key) && holds(p.active_when, settings)) matched[p.key] = settings.at(p.key);
    auto& truth = truths[{room.name, matched}];
    if (truth == 0) truth = scattered_light(room, "reference", matched, 1);
    return scattered_light(room, id, settings, frames) / truth;
}

class RoomLight : public testing::TestWithParam<Room> {
  protected:
    void SetUp() override {
        room_ = GetParam();
        if (room_.scene.rfind("builtin:", 0) == 0) return;
        const char* folder = std::getenv("INTERREFLECT_SCENES");
        if (!folder) GTEST_SKIP() << "set INTERREFLECT_SCENES to the folder that holds " << room_.scene;
        const auto file = std::filesystem::path(folder) / room_.scene;
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
        room_.scene = file.string();
    }
    void expect_within(double ratio, const Interval& bounds) {
        RecordProperty("ratio", std::to_string(ratio));
        EXPECT_GT(ratio, bounds.low);
        EXPECT_LT(ratio, bounds.high);
    }
    Room room_;
};

TEST_P(RoomLight, OfPhotonsIsTheReferences) {
    expect_within(light_ratio(room_, "photon-mapping", {}, 4), room_.photons);
}

TEST_P(RoomLight, OfMapsIsTheReferences) {
    expect_within(light_ratio(room_, "ldm-indirect", {}, 1), room_.maps);
}

TEST_P(RoomLight, OfDiscsIsTheReferences) {
    const Settings light{{"paths", std::string("full")}, {"max_distance", 0.0}};
    expect_within(light_ratio(room_, "deep-screen-space", light, 1), room_.discs);
}

scene::Light rectangle(glm::vec3 position, glm::vec2 extent, glm::vec3 colour, float radiance) {
    scene::Light light;
    light.type = scene::LightType::rectangle;
    light.position = position;
    light.direction = {0, -1, 0};
    light.size = extent;
    light.colour = colour;
    light.intensity = radiance;
    return light;
}

/// A panel below the ceiling of the conference room, which comes without light.
scene::Light panel(float x) {
    return rectangle({x, 1.85f, -0.5f}, {0.8f, 0.3f}, glm::vec3(1), 10);
}

const scene::Light lamp = rectangle({0, 0.54f, -0.28f}, {0.13f, 0.105f}, {1, 12 / 17.0f, 4 / 17.0f}, 17);

// What is beyond the aims of 0.95 to 1.05, and of 0.85 to 1.1 for discs, has its cause in docs/accuracy.md:
// to maps glass is opaque but for light samples through panes, few photons find the gap of a door, and panels
// hang nearer to the ceiling than texels of maps tell apart.
INSTANTIATE_TEST_SUITE_P(
    Rooms, RoomLight,
    testing::Values(
        Room{.name = "cornell", .scene = "builtin:cornell"},
        Room{.name = "rectangle", .scene = "builtin:cornell?emission=0&light=0", .lights = {{lamp}}},
        Room{.name = "sky", .scene = "builtin:cornell?emission=0&light=0", .environment = glm::vec3(1)},
        Room{.name = "still_life", .scene = "builtin:still-life"},
        Room{.name = "furnace", .scene = "builtin:furnace", .environment = glm::vec3(1)},
        Room{.name = "panels",
             .scene = "builtin:conference?emission=30",
             .lights = std::vector<scene::Light>{},
             .maps = {0.95, 1.05}},
        Room{.name = "cornell_box", .scene = "rooms/cornell-box/cornell-box.glb"},
        Room{.name = "conference", .scene = "conference.glb", .lights = {{panel(0), panel(2)}}},
        Room{.name = "veach_ajar",
             .scene = "rooms/veach-ajar/veach-ajar.glb",
             .photons = {0.8, 1.05},
             .maps = {0.95, 1.15},
             .samples = 256},
        Room{.name = "staircase2",
             .scene = "rooms/staircase2/staircase2.glb",
             .maps = {0.91, 0.97},
             .discs = {0.95, 1.05},
             .samples = 512},
        Room{.name = "staircase2_without_glass",
             .scene = "rooms/staircase2/staircase2.glb",
             .opaque = "GlassBSDF",
             .samples = 512}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace ir::test
