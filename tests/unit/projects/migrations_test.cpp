#include "projects/migrations.h"

#include <gtest/gtest.h>

#include "projects/document_json.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::read;

TEST(Migrations, StandInOrderWithoutGaps) {
    ASSERT_EQ(migrations().size(), static_cast<std::size_t>(schema_version - 1));
    for (std::size_t i = 0; i < migrations().size(); ++i)
        EXPECT_EQ(migrations()[i].from, static_cast<int>(i) + 1);
}

TEST(Migrations, FrozenFileOfSchema1Opens) {
    const auto old = read(testing::read_text(TEST_DATA "/projects/schema-1.json"));
    const Project& project = old.project;
    EXPECT_EQ(old.schema_in_file, 1);
    EXPECT_EQ(project.schema, schema_version);

    ASSERT_EQ(project.scenes.size(), 2u);
    ASSERT_EQ(project.scenes[0].parts.size(), 1u);
    EXPECT_EQ(project.scenes[0].parts[0].source, "../scenes/church.glb");
    EXPECT_EQ(project.scenes[0].parts[0].content_hash, "0123456789abcdef");
    EXPECT_EQ(project.scenes[0].extra, Json::object({{"licence", "CC0"}}));
    EXPECT_DOUBLE_EQ(project.cameras.at(0).fov_y_degrees, 45);
    EXPECT_TRUE(project.cameras.at(0).extra.empty());
    EXPECT_EQ(project.cameras.at(1).scene_camera, "nave");
    ASSERT_EQ(project.lights.at(0).lights.size(), 2u);
    EXPECT_EQ(project.lights[0].lights[0], parse_light("point:position=0,2,0;flux=40"));
    EXPECT_EQ(project.lights[0].lights[1].inner, 30);

    const Experiment& fog = project.experiments.at(0);
    EXPECT_EQ(fog.size, glm::ivec2(320, 240));
    EXPECT_EQ(fog.seed, 11u);
    EXPECT_EQ(fog.values.at("falloff"), Value{std::string("smooth")});
    EXPECT_EQ(fog.values.at("density"), Value{0.5});
    EXPECT_EQ(fog.values.at("late"), Value{0.0});  // new in version 3 of the method
    EXPECT_EQ(fog.values.at("forgotten"), Value{std::int64_t{3}});
    const Experiment& lost = project.experiments.at(1);
    EXPECT_EQ(lost.method, "teleport");
    EXPECT_EQ(lost.values.at("magic"), Value{1.5});
    EXPECT_EQ(project.extra, Json::object({{"mood", "curious"}}));

    const auto unknown = unknown_keys(project, testing::registry());
    EXPECT_EQ(unknown,
              (std::vector<std::string>{"/scenes/0/licence", "/experiments/0/values/forgotten", "/mood"}));
}

TEST(Migrations, FrozenFileOfSchema2Opens) {
    const auto old = read(testing::read_text(TEST_DATA "/projects/schema-2.json"));
    EXPECT_EQ(old.schema_in_file, 2);
    auto expected = testing::sample_project();
    expected.plots.clear();
    expected.motion.resize(1);
    EXPECT_EQ(old.project, expected);
    ASSERT_EQ(old.messages.size(), 4u);
    EXPECT_EQ(old.messages[0].text, "upgraded from schema 2 to 3: projects have plots of the error");
}

TEST(Migrations, FrozenFileOfSchema3Opens) {
    const auto old = read(testing::read_text(TEST_DATA "/projects/schema-3.json"));
    EXPECT_EQ(old.schema_in_file, 3);
    auto expected = testing::sample_project();
    expected.motion.resize(1);
    EXPECT_EQ(old.project, expected);
    ASSERT_EQ(old.messages.size(), 3u);
    EXPECT_EQ(old.messages[0].text,
              "upgraded from schema 3 to 4: motions say what they move: cameras, lights or parts of scenes");
}

TEST(Migrations, FrozenFileOfSchema4Opens) {
    const auto old = read(testing::read_text(TEST_DATA "/projects/schema-4.json"));
    EXPECT_EQ(old.schema_in_file, 4);
    EXPECT_EQ(old.project, testing::sample_project());
}

TEST(Migrations, FileOfSchema5Opens) {
    // Of what is in the file, schema 6 has nothing by another name.
    auto text = testing::read_text(TEST_DATA "/projects/schema-6.json");
    text.replace(text.find("6"), 1, "5");
    const auto old = read(text);
    EXPECT_EQ(old.schema_in_file, 5);
    EXPECT_EQ(old.project, testing::sample_project());
}

TEST(Migrations, KeysOfSchema5HaveTheirNewNamesWhereverTheyStand) {
    const auto project = read(R"({"schema": 5,
        "experiments": [{"id": "a", "method": "fog", "values": {"radius_min": 0.5, "stretch_max": 3.0},
                         "presets": {"p": {"values": {"radius_max": 2.0}}}}],
        "plots": [{"id": "d", "over": "radius_texels"}],
        "sweeps": [{"id": "e", "experiment": "a", "axes": [{"key": "ray_length_floor", "values": [1]}]}]})")
                             .project;
    const auto& values = project.experiments.at(0).values;
    EXPECT_EQ(values.at("min_radius"), Value{0.5});
    EXPECT_EQ(values.at("max_stretch"), Value{3.0});
    EXPECT_FALSE(values.contains("radius_min"));
    EXPECT_TRUE(project.experiments[0].presets.at("p").values.contains("max_radius"));
    EXPECT_EQ(project.plots.at(0).over, "min_radius_texels");
    EXPECT_EQ(project.sweeps.at(0).axes.at(0).key, "min_ray_length_scale");
}

TEST(Migrations, KeysOfSchema4HaveTheirNewNamesWhereverTheyStand) {
    const auto project = read(R"({"schema": 4,
        "experiments": [{"id": "a", "method": "fog", "values": {"largest_dip": 0.5, "samples": 3},
                         "presets": {"p": {"values": {"greatest_axis": 2.0}}}},
                        {"id": "b", "method": "fog", "values": {"largest_dip": 0.5, "max_dip": 1.0}}],
        "comparisons": [{"id": "c", "a": "a", "b": "b", "output": "hierarchy.most"}],
        "plots": [{"id": "d", "over": "least_roughness"}],
        "sweeps": [{"id": "e", "experiment": "a", "axes": [{"key": "least_distance", "values": [1]},
                                                           {"key": "samples", "values": [2]}]}]})")
                             .project;
    const auto& values = project.experiments.at(0).values;
    EXPECT_EQ(values.at("max_dip"), Value{0.5});
    EXPECT_EQ(values.at("samples"), Value{std::int64_t{3}});
    EXPECT_FALSE(values.contains("largest_dip"));
    EXPECT_TRUE(project.experiments[0].presets.at("p").values.contains("max_axis"));
    EXPECT_EQ(project.experiments.at(1).values.at("max_dip"), Value{1.0});  // somebody's own: nothing is lost
    EXPECT_EQ(project.experiments.at(1).values.at("largest_dip"), Value{0.5});
    EXPECT_EQ(project.comparisons.at(0).output, "hierarchy.max");
    EXPECT_EQ(project.plots.at(0).over, "min_roughness");
    EXPECT_EQ(project.sweeps.at(0).axes.at(0).key, "min_distance");
    EXPECT_EQ(project.sweeps.at(0).axes.at(1).key, "samples");
}

TEST(Migrations, WhatSchema3KeptInMotionsIsStillKept) {
    const auto old = read(
        R"({"schema": 3, "motion": [{"id": "m", "camera": "c", "moves": 1, "loop": "x", "part": 5, "keys": []}]})");
    const Motion& motion = old.project.motion.at(0);
    EXPECT_EQ(motion.kind, Motion::Kind::camera);
    EXPECT_EQ(motion.camera, "c");
    EXPECT_FALSE(motion.loop);
    EXPECT_EQ(motion.extra, Json::object({{"moves_of_schema_3", 1}, {"loop_of_schema_3", "x"}, {"part", 5}}));
}

TEST(Migrations, WhatSchema2KeptAsPlotsIsStillKept) {
    const auto old = read(R"({"schema": 2, "plots": 7, "plots_of_schema_2": 8})");
    EXPECT_TRUE(old.project.plots.empty());
    EXPECT_EQ(old.project.extra, Json::object({{"plots_of_schema_2_", 7}, {"plots_of_schema_2", 8}}));
}

TEST(Migrations, UpgradedTextIsStableAndNotes) {
    const auto old = read(testing::read_text(TEST_DATA "/projects/schema-1.json"));
    const auto text = write_project(old.project);
    const auto back = read(text);
    EXPECT_EQ(back.schema_in_file, schema_version);
    EXPECT_EQ(back.project, old.project);
    EXPECT_EQ(write_project(back.project), text);
    ASSERT_FALSE(old.messages.empty());
    EXPECT_EQ(old.messages[0].text.rfind("upgraded from schema 1 to 2", 0), 0u);
}

TEST(Migrations, WrongSchemasAreRefused) {
    for (const char* text : {"{}", R"({"schema": "2"})", R"({"schema": 0})", R"({"schema": -1})",
                             R"({"schema": 7})", R"({"schema": 1.5})", R"({"schema": 18446744073709551615})"})
        EXPECT_THROW(read(text), InputError) << text;
}

TEST(Migrations, WhatCannotBeUpgradedIsRefusedAtItsPlace) {
    const auto refusal = [](const std::string& text) -> std::string {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(refusal(R"({"schema": 1, "lights": [{"id": "a", "lights": ["lamp:x=1"]}]})")
                  .find("/lights/0/lights/0"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"schema": 1, "experiments": [{"id": "a", "method": "fog", "resolution": "big"}]})")
                  .find("/experiments/0/size"),
              std::string::npos);
    EXPECT_NE(
        refusal(R"({"schema": 1, "scenes": [{"id": "a", "file": 3}]})").find("/scenes/0/parts/0/source"),
        std::string::npos);
}

}  // namespace
}  // namespace ir::projects
