#include "projects/document.h"

#include <gtest/gtest.h>

#include "projects/edits.h"
#include "projects/motion.h"
#include "projects/validate.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::read;
using testing::sample_project;

std::string refusal(const Json& json) {
    try {
        read(pretty_json(json));
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// The sample with one member replaced.
std::string refusal_with(const std::string& pointer, const Json& value) {
    Json json = to_json(sample_project());
    json[Json::json_pointer(pointer)] = value;
    return refusal(json);
}

TEST(Document, RoundTripIsStableToTheByte) {
    const auto project = sample_project();
    const auto text = write_project(project);
    const auto back = read(text);
    EXPECT_EQ(back.project, project);
    EXPECT_EQ(write_project(back.project), text);
    EXPECT_TRUE(back.messages.empty());
}

TEST(Document, MatchesTheFrozenFileOfSchema5) {
    const auto text = testing::read_text(TEST_DATA "/projects/schema-6.json");
    EXPECT_EQ(write_project(read(text).project), text);
    EXPECT_EQ(read(text).project, sample_project());
}

TEST(Document, CameraPathsMayBeSmoothAndNothingElseIs) {
    auto project = sample_project();
    bool has_camera = false;
    for (auto& motion : project.motion) {
        motion.smooth = motion.kind == Motion::Kind::camera;
        has_camera |= motion.smooth;
    }
    ASSERT_TRUE(has_camera);
    auto json = to_json(project);
    EXPECT_EQ(read(pretty_json(json)).project, project);
    for (auto& motion : json["motion"]) motion["smooth"] = true;
    for (const auto& motion : read(pretty_json(json)).project.motion)
        EXPECT_EQ(motion.smooth, motion.kind == Motion::Kind::camera) << motion.id;
    for (auto& motion : json["motion"])
        if (motion["moves"] == "camera") motion["smooth"] = "very";
    EXPECT_NE(refusal(json).find("smooth"), std::string::npos);
}

TEST(Document, ASetShinesBesideTheScenesLights) {
    auto project = sample_project();
    project.lights[0].use_scene_lights = true;
    const auto json = to_json(project);
    EXPECT_EQ(json["lights"][0]["lights"][0], scene_lights);
    EXPECT_EQ(json["lights"][0]["lights"].size(), project.lights[0].lights.size() + 1);
    EXPECT_EQ(read(pretty_json(json)).project, project);
    EXPECT_NO_THROW(validate(project.lights[0]));
}

/// Every object of the tree, by pointer.
void collect_objects(const Json& json, const std::string& pointer, std::vector<std::string>& out) {
    if (json.is_object()) out.push_back(pointer);
    if (!json.is_structured()) return;
    const auto flat = json.items();
    for (const auto& item : flat) collect_objects(item.value(), pointer + "/" + item.key(), out);
}

TEST(Document, UnknownKeysSurviveAtEveryLevelAndAreListed) {
    Json json = to_json(sample_project());
    std::vector<std::string> places;
    collect_objects(json, "", places);
    std::vector<std::string> planted;
    for (const auto& place : places) {
        // Their members are presets and materials by name.
        if (place.ends_with("/presets") || place.ends_with("/materials")) continue;
        json[Json::json_pointer(place)]["from_the_future"] = {{"deep", {1, 2.5, "x", nullptr}}};
        planted.push_back(place + "/from_the_future");
    }
    ASSERT_GT(planted.size(), 20u);
    const auto once = read(pretty_json(json));
    const auto text = write_project(once.project);
    const Json written = parse_json(text, "f");
    for (const auto& place : planted)
        EXPECT_EQ(written.at(Json::json_pointer(place)), json.at(Json::json_pointer(place))) << place;
    EXPECT_EQ(write_project(read(text).project), text);

    auto listed = unknown_keys(once.project, testing::registry());
    std::sort(listed.begin(), listed.end());
    std::sort(planted.begin(), planted.end());
    EXPECT_EQ(listed, planted);
}

TEST(Document, UnknownMethodsAreKeptWithAllTheirValues) {
    Json json = to_json(sample_project());
    json["experiments"][0]["method"] = "teleport";
    json["experiments"][0]["values"] = {{"whole", 4}, {"real", 4.0}, {"flag", true}, {"list", {1, 2}}};
    const auto text = pretty_json(json);
    const auto back = read(text);
    EXPECT_EQ(back.project.experiments.at(0).method, "teleport");
    const Json written = parse_json(write_project(back.project), "f");
    for (const char* key : {"whole", "real", "flag", "list"}) {
        const auto& value = written.at("experiments").at(0).at("values").at(key);
        EXPECT_EQ(value, json["experiments"][0]["values"][key]) << key;
        EXPECT_EQ(value.is_number_float(), std::string(key) == "real") << key;
    }
    EXPECT_TRUE(unknown_keys(back.project, testing::registry()).empty());
}

TEST(Document, WrongValuesNameFilePointerAndMend) {
    const std::string samples = "/experiments/0/values/samples";
    EXPECT_EQ(refusal_with(samples, 5000),
              "test.json: /experiments/0/values/samples: parameter 'samples': '5000' is not allowed; give an "
              "integer from 1 to 4096");
    EXPECT_NE(refusal_with(samples, "many").find(samples), std::string::npos);
    EXPECT_NE(refusal_with(samples, 1.5).find(samples), std::string::npos);
    EXPECT_NE(refusal_with(samples, Json::array({1})).find("must be a plain value"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/transport/paths", "full").find("ao, direct"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/presets/paper/values/samples", 0).find("/presets/paper"),
              std::string::npos);
}

TEST(Document, WrongStructureNamesThePlace) {
    EXPECT_NE(refusal_with("/scenes", "x").find("test.json: /scenes: must be an array"), std::string::npos);
    EXPECT_NE(refusal_with("/scenes/0", 3).find("/scenes/0: must be an object"), std::string::npos);
    EXPECT_NE(refusal_with("/scenes/0/id", "../evil").find("is no id"), std::string::npos);
    EXPECT_NE(refusal_with("/scenes/1/id", "church").find("stands twice"), std::string::npos);
    EXPECT_NE(refusal_with("/scenes/0/parts", Json::array()).find("at least one"), std::string::npos);
    const std::string material = "/scenes/0/parts/1/materials/gold";
    EXPECT_NE(refusal_with(material, 1).find(material + ": must be an object"), std::string::npos);
    EXPECT_NE(
        refusal_with(material + "/metallic", 1.5).find(material + "/metallic: must be a number from 0 to 1"),
        std::string::npos);
    EXPECT_NE(refusal_with(material + "/base_colour", {1, 1, 1}).find("array of 4 numbers"),
              std::string::npos);
    EXPECT_NE(refusal_with(material + "/emission", {1, -1, 0}).find("/emission: must be 3 numbers from 0"),
              std::string::npos);
    EXPECT_NE(refusal_with("/cameras/0/fov_y_degrees", 180).find("0.001 to 179.999"), std::string::npos);
    EXPECT_NE(refusal_with("/cameras/0/eye", {1, 2}).find("array of 3 numbers"), std::string::npos);
    EXPECT_NE(refusal_with("/lights/0/id", "scene").find("stands for the scene's own"), std::string::npos);
    EXPECT_NE(refusal_with("/lights/0/lights/1/inner", 60).find("/lights/0/lights/1: spot light: inner"),
              std::string::npos);
    EXPECT_NE(refusal_with("/lights/0/environment", true).find("must be \"scene\""), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/size", {0, 5}).find("[width, height]"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/size", {1e300, 5}).find("[width, height]"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/seed", -1).find("at least 0"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/frames", 0).find("from 1"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/active_preset", "none").find("not among the presets"),
              std::string::npos);
    EXPECT_NE(refusal_with("/motion/0/keys/1/time", 0).find("later than"), std::string::npos);
    EXPECT_NE(refusal(Json::array()).find("is no project"), std::string::npos);
}

TEST(Document, LimitsThemselvesAreAllowed) {
    auto project = sample_project();
    auto& e = project.experiments[0];
    e.size = {max_image_side, 1};
    e.frames = max_frames;
    e.time = -max_seconds;
    e.seed = std::numeric_limits<std::uint64_t>::max();
    e.presets["most"] = {.size = glm::ivec2(1, max_image_side), .frames = max_frames, .values = {}};
    project.cameras[0].fov_y_degrees = max_fov_degrees;
    const auto back = read(write_project(project));
    EXPECT_EQ(back.project, project);
    EXPECT_NO_THROW(validate(back.project.experiments[0]));
    EXPECT_NO_THROW(edits::set_frames(project, e.id, max_frames));
    for (const auto& [key, beyond] :
         {std::pair<std::string, Json>("size", {1, max_image_side + 1}), {"frames", max_frames + 1}})
        for (const std::string place : {"/experiments/0/", "/experiments/0/presets/paper/"})
            EXPECT_NE(refusal_with(place + key, beyond).find(key + ": must be"), std::string::npos);
    EXPECT_NE(refusal_with("/experiments/0/time", 2 * max_seconds).find("time: must be a number from"),
              std::string::npos);
    EXPECT_THROW(edits::set_size(project, e.id, {0, 1}), UsageError);
    EXPECT_THROW(edits::set_frames(project, e.id, 0), UsageError);
    EXPECT_THROW(edits::set_time(project, e.id, 2 * max_seconds), UsageError);
}

TEST(Document, ValuesOfNewerParametersComeFromTheirDescription) {
    Json json = to_json(sample_project());
    json["experiments"][0]["values"].erase("late");
    json["experiments"][0]["method_version"] = 2;
    auto older = read(pretty_json(json));
    EXPECT_EQ(older.project.experiments[0].values.at("late"), Value{0.0});  // as before version 3
    ASSERT_EQ(older.messages.size(), 1u);
    EXPECT_NE(older.messages[0].text.find("as before version 3"), std::string::npos);

    json["experiments"][0]["method_version"] = 3;
    json["experiments"][0]["values"].erase("samples");
    auto removed = read(pretty_json(json));
    EXPECT_EQ(removed.project.experiments[0].values.at("late"), Value{0.5});  // the default
    EXPECT_EQ(removed.project.experiments[0].values.at("samples"), Value{std::int64_t{16}});
    EXPECT_TRUE(removed.messages.empty()) << "what is left out has its default: that is no news";
}

TEST(Document, WithoutAVersionValuesAreThoseOfTheMethodAsItIs) {
    Json json = to_json(sample_project());
    auto& experiment = json["experiments"][0];
    experiment.erase("method_version");
    experiment["values"].erase("late");
    const auto by_hand = read(pretty_json(json));
    EXPECT_EQ(by_hand.project.experiments[0].method_version, 3);
    EXPECT_EQ(by_hand.project.experiments[0].values.at("late"), Value{0.5});
    EXPECT_TRUE(by_hand.messages.empty());

    // A file of an older schema is older than what came later.
    json["schema"] = schema_version - 1;
    for (auto& motion : json["motion"])
        for (const char* key : {"moves", "loop"}) motion.erase(key);
    const auto older = read(pretty_json(json));
    EXPECT_EQ(older.project.experiments[0].values.at("late"), Value{0.0});
    EXPECT_EQ(older.project.experiments[0].method_version, 3);
    ASSERT_EQ(older.messages.size(), 2u);  // the schema, and that value
    EXPECT_NE(older.messages[1].text.find("as before version 3"), std::string::npos);
}

TEST(Document, ValuesMayStandInEitherGroupButNotInBoth) {
    Json json = to_json(sample_project());
    json["experiments"][0]["values"]["max_distance"] = 3;
    EXPECT_NE(refusal(json).find("stands in both"), std::string::npos);
    json["experiments"][0]["transport"].erase("max_distance");
    const auto back = read(pretty_json(json));
    EXPECT_EQ(back.project.experiments[0].values.at("max_distance"), Value{3.0});
    EXPECT_TRUE(to_json(back.project)["experiments"][0]["transport"].contains("max_distance"));
}

TEST(Document, PresetsOverrideWhatTheyName) {
    auto e = sample_project().experiments[0];
    EXPECT_EQ(effective(e).size, glm::ivec2(1024, 1024));
    EXPECT_EQ(effective(e).values.at("samples"), Value{std::int64_t{256}});
    EXPECT_EQ(effective(e).frames, 4);
    e.active_preset = "preview";
    EXPECT_EQ(effective(e).frames, 1);
    EXPECT_EQ(effective(e).values.at("samples"), Value{std::int64_t{16}});
    e.active_preset.clear();
    EXPECT_EQ(effective(e).size, glm::ivec2(640, 480));
}

TEST(Document, RunnableSettingsLeaveOutUnknownKeys) {
    auto e = sample_project().experiments[0];
    e.values["gone"] = 1.0;
    e.values.erase("density");
    const auto settings = runnable_settings(e, testing::registry().at("fog"));
    EXPECT_EQ(settings.count("gone"), 0u);
    EXPECT_EQ(settings.at("density"), Value{0.25});
    EXPECT_EQ(settings.at("samples"), Value{std::int64_t{256}});  // of the active preset
}

TEST(Document, CamerasFollowTheirMotion) {
    const auto project = sample_project();
    const auto& orbit = project.cameras[0];
    EXPECT_EQ(camera_at(project, orbit, -1).eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(camera_at(project, orbit, 0.5).eye, glm::dvec3(1.5, 2, 2.5));
    EXPECT_EQ(camera_at(project, orbit, 9).eye, glm::dvec3(3, 2, 1));
    EXPECT_EQ(camera_at(project, project.cameras[1], 1), project.cameras[1]);
}

TEST(Document, FreeIdsAreValidAndFree) {
    EXPECT_EQ(free_id("Nave, paper view!", {}), "nave-paper-view");
    EXPECT_EQ(free_id("a", {"a", "a-2"}), "a-3");
    EXPECT_EQ(free_id("../..", {}), "item");
    EXPECT_NE(free_id("Scene", {}), scene_lights);
    for (const char* bad : {"", ".hidden", "a/b", "a b", "ä", ".."}) EXPECT_FALSE(is_valid_id(bad)) << bad;
}

}  // namespace
}  // namespace ir::projects
