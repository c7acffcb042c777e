// All light of a picture by photons, at the defaults, against the reference's of the same transport: from
// lights without and with an extent, emissive meshes and the environment.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "renderers/core/transport.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

struct Room {
    std::string name, scene;
    std::string camera = "";
    std::optional<std::vector<scene::Light>> lights = {};  ///< in place of the scene's
    std::optional<glm::vec3> environment = {};
    double low = 0.95, high = 1.05;
    int size = 64, samples = 256;
    Settings settings = {};
};

std::ostream& operator<<(std::ostream& out, const Room& room) {
    return out << room.name;
}

const MethodDescription& description_of(const std::string& id) {
    for (const auto* method : methods::all_methods())
        if (method->description.id == id) return method->description;
    throw std::logic_error("no method " + id);
}

Image picture_of(const Room& room, const std::string& method, const Settings& settings, int frames) {
    engine::Experiment experiment;
    experiment.scene = room.scene;
    experiment.camera_name = room.camera;
    experiment.method = method;
    experiment.settings = with(defaults(description_of(method).parameters), settings);
    if (room.lights) {
        experiment.lights = *room.lights;
        experiment.replace_lights = true;
    }
    if (room.environment) {
        experiment.environment = scene::Environment{*room.environment, nullptr};
    }
    experiment.width = experiment.height = room.size;
    experiment.seed = 3;
    engine::Execution execution(machine(), experiment);
    for (int i = 0; i < frames; ++i) execution.run_frame({});
    return main_result(execution);
}

/// Means over all pixels, in the order red, green, blue.
glm::dvec3 mean_of(const Image& image) {
    glm::dvec3 sum(0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += glm::dvec3(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2));
    return sum / static_cast<double>(image.width * image.height);
}

double luminance(glm::dvec3 rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

class PhotonMappingLight : public testing::TestWithParam<Room> {};

TEST_P(PhotonMappingLight, IsTheReferencesAtTheDefaults) {
    auto room = GetParam();
    if (room.scene.rfind("builtin:", 0) != 0) {
        const char* folder = std::getenv("INTERREFLECT_SCENES");
        if (!folder) GTEST_SKIP() << "set INTERREFLECT_SCENES to the folder that holds " << room.scene;
        const auto file = std::filesystem::path(folder) / room.scene;
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
        room.scene = file.string();
    }
    Settings matched = room.settings;
    for (const auto& p : description_of("photon-mapping").parameters)
        if (is_transport_key(p.key) && !matched.contains(p.key)) matched[p.key] = p.default_value;
    matched["samples"] = std::int64_t{room.samples};
    const auto truth = mean_of(picture_of(room, "reference", matched, 1));
    ASSERT_GT(luminance(truth), 0);
    const auto found = mean_of(picture_of(room, "photon-mapping", room.settings, 4));
    const double ratio = luminance(found) / luminance(truth);
    RecordProperty("ratio", std::to_string(ratio));
    EXPECT_GT(ratio, room.low) << luminance(found) << " of " << luminance(truth);
    EXPECT_LT(ratio, room.high) << luminance(found) << " of " << luminance(truth);
}

scene::Light rectangle() {
    scene::Light light;
    light.type = scene::LightType::rectangle;
    light.position = {0, 0.54f, -0.28f};
    light.direction = {0, -1, 0};
    light.size = {0.13f, 0.105f};
    light.colour = {1, 12 / 17.0f, 4 / 17.0f};
    light.intensity = 17;
    return light;
}

/// A panel below the ceiling of the conference room, which comes without light.
scene::Light panel(float x, float z) {
    scene::Light light;
    light.type = scene::LightType::rectangle;
    light.position = {x, 1.85f, z};
    light.direction = {0, -1, 0};
    light.size = {0.8f, 0.3f};
    light.intensity = 10;
    return light;
}

// What is below 0.95 has its cause in glass, at which photons and light samples end: docs/accuracy.md.
INSTANTIATE_TEST_SUITE_P(
    Rooms, PhotonMappingLight,
    testing::Values(
        Room{.name = "cornell", .scene = "builtin:cornell"},
        Room{.name = "rectangle", .scene = "builtin:cornell?emission=0&light=0", .lights = {{rectangle()}}},
        Room{.name = "sky", .scene = "builtin:corner", .environment = glm::vec3(1)},
        Room{.name = "still_life", .scene = "builtin:still-life"},
        Room{.name = "cornell_box", .scene = "rooms/cornell-box/cornell-box.glb"},
        Room{.name = "conference", .scene = "conference.glb", .lights = {{panel(0, -0.5f), panel(2, -0.5f)}}},
        Room{.name = "staircase2", .scene = "rooms/staircase2/staircase2.glb", .low = 0.87}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace ir::test
