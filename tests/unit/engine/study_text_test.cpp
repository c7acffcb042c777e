#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "app/engine/error_study.h"
#include "app/engine/kept_study.h"
#include "renderers/core/error.h"
#include "tests/unit/scene/gltf_builder.h"

namespace ir::engine {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

ErrorPoint point(double ms, double rmse, const std::string& problem = "") {
    ErrorPoint result;
    result.experiment = "e";
    result.value = 1;
    result.ms = ms;
    result.errors = {{"rmse", rmse}, {"psnr", -20 * std::log10(rmse)}};
    result.problem = problem;
    if (!problem.empty()) result.errors.clear();
    return result;
}

std::vector<bool> front_of(std::vector<ErrorPoint> points, const std::string& metric = "rmse") {
    mark_front(points, metric);
    std::vector<bool> front;
    for (const auto& each : points) front.push_back(each.on_front);
    return front;
}

TEST(Front, IsWhatNoOtherBeatsInTimeAndError) {
    EXPECT_EQ(front_of({point(1, 0.5), point(2, 0.2), point(3, 0.3), point(4, 0.1)}),
              (std::vector<bool>{true, true, false, true}));
    // The same by a metric of which more is better.
    EXPECT_EQ(front_of({point(1, 0.5), point(2, 0.2), point(3, 0.3), point(4, 0.1)}, "psnr"),
              (std::vector<bool>{true, true, false, true}));
}

TEST(Front, TiesStandOnItTogetherUnlessOneIsBetter) {
    EXPECT_EQ(front_of({point(1, 0.5), point(1, 0.5)}), (std::vector<bool>{true, true}));
    EXPECT_EQ(front_of({point(1, 0.5), point(1, 0.4)}), (std::vector<bool>{false, true}));
    EXPECT_EQ(front_of({point(1, 0.5), point(2, 0.5)}), (std::vector<bool>{true, false}));
}

TEST(Front, LeavesOutWhatHasNoNumber) {
    EXPECT_EQ(front_of({point(1, 0.1, "refused"), point(2, std::nan("")), point(3, 0.5)}),
              (std::vector<bool>{false, false, true}));
    EXPECT_EQ(front_of({point(1, 0.1)}, "no-such-metric"), std::vector<bool>{false});
    // Equal pictures have an infinite PSNR: nothing is better.
    EXPECT_EQ(front_of({point(2, 0), point(1, 0.1), point(3, 0)}, "psnr"),
              (std::vector<bool>{true, true, false}));
}

ErrorStudy study() {
    ErrorStudy result;
    result.plot = "directions";
    result.device = "a, \"device\"";
    result.metrics = {"rmse", "psnr"};
    result.reference_noise = 1.25e-3;
    result.notes = {"a note"};
    result.points = {point(1.5, 0.25), point(2.5, 0), point(0, 0, "value 9 is \"refused\", it says")};
    result.points[0].value = "two, three";
    result.points[1].value = projects::Json::array({1, 2});
    result.points[1].memory_bytes = std::uint64_t(1) << 40;
    result.points[0].pixels = result.points[1].pixels = 12;
    result.points[0].on_front = true;
    result.points[1].frames = 8;
    result.points[2].frames = 1;
    return result;
}

TEST(StudyText, JsonComesBackAsItWas) {
    const auto text = study_json(study());
    const auto back = study_from_json(text, "f");
    EXPECT_EQ(study_json(back), text);
    EXPECT_EQ(back.points.size(), 3u);
    EXPECT_EQ(back.points[1].errors.at("psnr"), infinity);
    EXPECT_EQ(back.points[1].value, projects::Json::array({1, 2}));
    EXPECT_EQ(back.points[1].memory_bytes, std::uint64_t(1) << 40);
    EXPECT_EQ(back.points[2].problem, "value 9 is \"refused\", it says");
    EXPECT_TRUE(back.points[0].on_front);
    EXPECT_EQ(back.reference_noise, 1.25e-3);
    EXPECT_EQ(back.notes, study().notes);
}

TEST(StudyText, NumbersThatAreNotFiniteAreNullWithAReason) {
    auto written = study();
    written.points[0].errors["rmse"] = std::nan("");
    written.points[0].errors["relbias"] = -infinity;
    const auto json = projects::parse_json(study_json(written), "f");
    const auto& first = json["points"][0];
    EXPECT_TRUE(first["errors"]["rmse"].is_null());
    EXPECT_EQ(first["reasons"]["relbias"], "minus infinite: the mean of the reference is 0");
    EXPECT_EQ(first["reasons"]["rmse"], "undefined");
    EXPECT_TRUE(json["points"][1]["errors"]["psnr"].is_null());
    const auto back = study_from_json(study_json(written), "f");
    EXPECT_TRUE(std::isnan(back.points[0].errors.at("rmse")));
    EXPECT_EQ(back.points[0].errors.at("relbias"), -infinity);
    EXPECT_EQ(back.points[1].errors.at("psnr"), infinity);
}

TEST(StudyText, StudiesOfTheFirstBuildsAreRead) {
    const auto old = study_from_json(
        "{\"points\": [{\"experiment\": \"e\", \"errors\": {\"psnr\": \"inf\", \"rmse\": \"nan\"}}]}", "f");
    EXPECT_EQ(old.points[0].errors.at("psnr"), infinity);
    EXPECT_TRUE(std::isnan(old.points[0].errors.at("rmse")));
}

TEST(StudyText, DamagedJsonIsRefusedInOneLine) {
    for (const char* text :
         {"", "[]", "{\"points\": 1}", "{\"points\": [1]}", "{\"points\": [{\"experiment\": 1}]}",
          "{\"points\": [{\"experiment\": \"e\", \"ms\": -1}]}",
          "{\"points\": [{\"experiment\": \"e\", \"errors\": {\"rmse\": \"much\"}}]}",
          "{\"metrics\": [1]}"}) {
        try {
            study_from_json(text, "file.json");
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).rfind("file.json", 0), 0u) << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_TRUE(study_from_json("{\"from the future\": {}}", "f").points.empty());
}

TEST(StudyText, TablesHaveARowAPoint) {
    const auto table = study_csv(study());
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);
    EXPECT_EQ(table.substr(0, table.find("\r\n")),
              "experiment,value,frames,ms,rmse,psnr,pixels,skipped,memory_bytes,on_front,problem");
    EXPECT_NE(table.find("e,\"two, three\",1,1.5,0.25,12.0411998,12,0,0,1,\r\n"), std::string::npos) << table;
    EXPECT_NE(table.find("e,\"[1,2]\",8,2.5,0,inf,"), std::string::npos) << table;
    EXPECT_NE(table.find("e,1,1,,,,,,,0,\"value 9 is \"\"refused\"\", it says\"\r\n"), std::string::npos)
        << table;
}

/// A project of one experiment against another, of the built-in plane.
projects::Project project() {
    projects::Project result;
    result.scenes = {{"plane", "Plane", {{"builtin:plane@1", "", {}}}}};
    for (const char* id : {"a", "truth"}) {
        projects::Experiment experiment;
        experiment.id = experiment.name = id;
        experiment.scene = "plane";
        experiment.method = "reference";
        experiment.values = defaults(registry().at("reference").parameters);
        result.experiments.push_back(experiment);
    }
    result.experiments[1].seed = 7;
    projects::ErrorPlot plot;
    plot.id = plot.name = "p";
    plot.reference = "truth";
    plot.experiments = {"a"};
    result.plots = {plot};
    return result;
}

TEST(KeptStudy, ComesBackAndKnowsWhatMakesItStale) {
    const test::TemporaryFolder folder;
    auto p = project();
    EXPECT_FALSE(load_study(folder.path, "p"));
    keep_study(p, p.plots[0], folder.path, study());
    const auto kept = load_study(folder.path, "p");
    ASSERT_TRUE(kept);
    EXPECT_EQ(study_json(kept->study), study_json(study()));
    EXPECT_FALSE(kept->date.empty());
    EXPECT_FALSE(is_stale(*kept, p, p.plots[0]));

    const auto stale_after = [&](auto change) {
        auto changed = p;
        change(changed);
        return is_stale(*kept, changed, changed.plots[0]);
    };
    EXPECT_FALSE(stale_after([](auto& c) { c.plots[0].name = "other"; }));
    EXPECT_FALSE(stale_after([](auto& c) { c.plots[0].metric = "mae"; }));
    EXPECT_FALSE(stale_after([](auto& c) { c.plots[0].against_time = false; }));
    EXPECT_FALSE(stale_after([](auto& c) { c.experiments[0].name = "other"; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.plots[0].values = {1}; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.plots[0].over = "seed"; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.plots[0].experiments = {"truth"}; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.experiments[0].seed = 99; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.experiments[1].seed = 99; }));
    EXPECT_TRUE(stale_after([](auto& c) { c.scenes[0].parts[0].source = "builtin:cornell@1"; }));
}

TEST(KeptStudy, DamagedFilesAreRefusedInOneLine) {
    const test::TemporaryFolder folder;
    auto p = project();
    keep_study(p, p.plots[0], folder.path, study());
    for (const char* text : {"", "{}", "{\"schema\": 9, \"study\": {}}", "{\"study\": 3}"}) {
        std::ofstream(study_file(folder.path, "p")) << text;
        try {
            load_study(folder.path, "p");
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace ir::engine
