#include "tests/unit/projects/sample.h"

#include <algorithm>

#include <fstream>
#include <sstream>

#include "renderers/core/transport.h"

namespace ir::projects::testing {
namespace {

struct FogSettings {
    enum class Model { thin, thick };
    Transport transport;
    int samples = 16;
    double density = 0.25;
    bool jitter = true;
    Model model = Model::thin;
    float late = 0.5f;
};

MethodDescription describe_fog() {
    ParameterTable<FogSettings> table;
    table.include(&FogSettings::transport,
                  transport_parameters({{"ao", "direct"}, {"max_distance", "falloff"}}));
    table.add(
        &FogSettings::samples,
        {.key = "samples", .label = "Samples", .doc = "Per pixel.", .hard = {1, 4096}, .soft = {1, 64}});
    table.add(&FogSettings::density, {.key = "density", .label = "Density", .doc = "", .hard = {0, 100}});
    table.add(&FogSettings::jitter, {.key = "jitter", .label = "Jitter", .doc = ""});
    table.add(&FogSettings::model, {.key = "model",
                                    .label = "Model",
                                    .doc = "",
                                    .choices = {{"thin", "Thin", ""}, {"thick", "Thick", ""}}});
    table.add(&FogSettings::late, {.key = "late",
                                   .label = "Late",
                                   .doc = "",
                                   .hard = {0, 1},
                                   .since_version = 3,
                                   .value_in_older_projects = Value{0.0}});
    MethodDescription method;
    method.id = "fog";
    method.title = "Fog";
    method.version = 3;
    method.parameters = table.descriptions();
    return method;
}

struct PlainSettings {
    int samples = 4;
    double weight = 1;
};

MethodDescription describe_plain() {
    ParameterTable<PlainSettings> table;
    table.add(&PlainSettings::samples, {.key = "samples", .label = "Samples", .doc = "", .hard = {1, 8}});
    table.add(&PlainSettings::weight, {.key = "weight", .label = "Weight", .doc = "", .hard = {0, 2}});
    MethodDescription method;
    method.id = "plain";
    method.title = "Plain";
    method.parameters = table.descriptions();
    return method;
}

Experiment fog_experiment() {
    Experiment e;
    e.id = "fog-nave";
    e.name = "Fog in the nave";
    e.scene = "church";
    e.camera = "orbit";
    e.lights = "evening";
    e.method = "fog";
    e.method_version = 3;
    e.values = defaults(registry().at("fog").parameters);
    e.values["density"] = 0.1;
    e.size = {640, 480};
    e.seed = 7;
    e.frames = 4;
    e.time = 0.5;
    e.notes = "Ä first look:\n\"quoted\"";
    e.reference = "plain-nave";
    e.presets["paper"].size = glm::ivec2(1024, 1024);
    e.presets["paper"].values["samples"] = std::int64_t{256};
    e.presets["preview"].size = glm::ivec2(256, 192);
    e.presets["preview"].frames = 1;
    e.active_preset = "paper";
    return e;
}

Experiment plain_experiment() {
    Experiment e;
    e.id = "plain-nave";
    e.name = "Plain";
    e.scene = "room";
    e.camera = "inside";
    e.method = "plain";
    e.values = defaults(registry().at("plain").parameters);
    return e;
}

LightSet evening() {
    LightSet set;
    set.id = "evening";
    set.name = "Evening";
    set.lights = {
        parse_light("point:position=0,2,0;flux=40"),
        parse_light("spot:position=0,3,0;target=0,0,0;intensity=10;outer=30;inner=20;color=1,0.9,0.8"),
        parse_light("directional:direction=0,-1,0.2;irradiance=3"),
        parse_light("rect:position=0,3,0;target=0,0,0;size=1,2;radiance=5")};
    set.light_extras.assign(4, Json::object());
    set.environment.kind = Environment::Kind::constant;
    set.environment.constant = {0.1, 0.2, 0.3};
    return set;
}

Motion swinging_spot() {
    Motion motion{"spot", "The spot swings", "", {}};
    motion.kind = Motion::Kind::light;
    motion.lights = "evening";
    motion.light = 1;
    motion.loop = true;
    motion.keys.resize(3);
    for (int i = 0; i < 3; ++i) {
        motion.keys[std::size_t(i)].time = 0.25 + i;
        motion.keys[std::size_t(i)].position = {i, 3, 0};
        motion.keys[std::size_t(i)].look_at = {0, 0, i};
        motion.keys[std::size_t(i)].intensity = 1.0 / (1 << i);
    }
    return motion;
}

Motion sliding_church() {
    Motion motion{"slide", "The church slides", "", {}};
    motion.kind = Motion::Kind::part;
    motion.scene = "church";
    motion.keys.resize(2);
    motion.keys[1].time = 4;
    motion.keys[1].translation = {1, 0, 2};
    motion.keys[1].rotation = {0, 90, 0};
    motion.keys[1].scale = {1, 2, 1};
    return motion;
}

}  // namespace

const Registry& registry() {
    static const MethodDescription fog = describe_fog(), plain = describe_plain();
    static const Registry all({&fog, &plain});
    return all;
}

Project sample_project() {
    Project project;
    project.name = "Sample";
    project.notes = "Two lines,\nof notes.";
    project.scenes = {{"church", "Church", {{"scenes/church.glb", "0123456789abcdef", {}}}},
                      {"room", "Room", {{"builtin:room@1?side=4", "", {}}}}};
    std::array<double, 16> moved{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2.5, 0, -1, 1};
    project.scenes[0].parts.push_back({"scenes/organ.glb", "fedcba9876543210", moved});
    auto& materials = project.scenes[0].parts[1].materials;
    materials["gold"].base_colour = {1, 0.75, 0.25, 1};
    materials["gold"].roughness = 0.3;
    materials["candles"].emission = {12, 9.5, 4};
    Camera orbit{{{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}}, 40.5}, "orbit", "Orbit", ""};
    Camera inside{{}, "inside", "Inside", "nave"};
    project.cameras = {orbit, inside};
    project.lights = {evening()};
    LightSet own;
    own.id = "own";
    own.name = "The scene's own, but a map";
    own.use_scene_lights = true;
    own.environment = {Environment::Kind::map, {}, "sky.exr", "00ff"};
    project.lights.push_back(own);
    project.motion = {{"walk", "Walk", "orbit", {{{{1, 2, 3}, {0, 1, 0}}, 0}, {{{3, 2, 1}, {0, 1, 0}}, 2}}}};
    project.motion.push_back(swinging_spot());
    project.motion.push_back(sliding_church());
    project.images = {{"photo", "Photograph", "photo.exr", "", "from the archive"}};
    project.experiments = {fog_experiment(), plain_experiment()};
    Comparison both, real;
    both.id = "both";
    both.name = "Both";
    both.a = real.a = "fog-nave";
    both.b = "plain-nave";
    both.output = "accessibility";
    both.mode = "difference";
    both.range = glm::dvec2(0, 0.5);
    real.id = "real";
    real.name = "Against the photograph";
    real.b = "photo";
    project.comparisons = {both, real};
    project.sweeps = {{"counts", "Counts", "fog-nave", {{"samples", {1, 4, 16}}, {"seed", {1, 2}}}}};
    ErrorPlot counts, over_time;
    counts.id = "error-of-counts";
    counts.name = "Error of the fog";
    counts.reference = "plain-nave";
    counts.experiments = {"fog-nave", "plain-nave"};
    counts.over = "samples";
    counts.values = {1, 4, 16};
    counts.metric = "mae";
    counts.against_time = false;
    counts.notes = "Falls with the square root.";
    over_time.id = "over-time";
    over_time.name = "Against the photograph";
    over_time.reference = "photo";
    project.plots = {counts, over_time};
    return project;
}

TemporaryFolder::TemporaryFolder(Place place) {
    const char* pattern = "interreflect-test-XXXXXX";
    std::string name = std::string("/dev/shm/") + pattern;
    if (place == Place::disk || !::mkdtemp(name.data())) {
        name = (std::filesystem::temp_directory_path() / pattern).string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void write_sample_files(const std::filesystem::path& folder) {
    for (const char* file : {"scenes/church.glb", "scenes/organ.glb", "sky.exr", "photo.exr"})
        write_text(folder / file, std::string("content of ") + file);
}

Project unhashed_sample() {
    auto project = sample_project();
    for (auto& part : project.scenes[0].parts) part.content_hash.clear();
    project.lights[1].environment.content_hash.clear();
    return project;
}

bool mentions(const std::vector<Message>& messages, const std::string& text) {
    return std::any_of(messages.begin(), messages.end(),
                       [&](const auto& each) { return each.text.find(text) != std::string::npos; });
}

std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

}  // namespace ir::projects::testing
