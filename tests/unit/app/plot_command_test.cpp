// `interreflect-cli plot`, `bench error` and `sweep`: statuses, tables, files, on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

/// A copy of the sample with small pictures and few values.
class PlotCommand : public testing::Test {
  protected:
    PlotCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("plot-" + std::string(test->name()));
        fs::remove_all(root_);
        project_ = root_ / "p.interreflect";
        fs::create_directories(project_);
        json = Json::parse(
            read(fs::path(SOURCE_ROOT) / "projects/samples/atrium-error.interreflect/project.json"));
        json["scenes"][0]["parts"] = {{{"source", "builtin:cornell@1"}}};
        json["cameras"] = Json::array();
        for (auto& experiment : json["experiments"]) {
            experiment["size"] = {16, 12};
            experiment["camera"] = "";
            if (experiment["id"] == "reference") experiment["values"]["samples"] = 64;
        }
        json["plots"][0]["values"] = {8, 16};
        json["sweeps"][0]["axes"][0]["values"] = {8, 16, 24};
        store();
    }
    ~PlotCommand() override { fs::remove_all(root_); }
    void store() { std::ofstream(project_ / "project.json") << json.dump(2); }

    Outcome run(const std::string& arguments) { return run_program(arguments, root_); }
    Outcome plot(const std::string& flags) { return run("plot " + path() + " --quiet " + flags); }
    std::string path() const { return project_.string(); }
    std::string file(const std::string& name) const { return (root_ / name).string(); }
    void expect_refused(const std::string& arguments, int status, const std::string& part) {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        const auto notes = outcome.err.rfind("note: ");
        const auto last = notes == std::string::npos ? 0 : outcome.err.find('\n', notes) + 1;
        EXPECT_EQ(std::count(outcome.err.begin() + std::ptrdiff_t(last), outcome.err.end(), '\n'), 1)
            << outcome.err;
    }

    Json json;
    fs::path root_, project_;
};

TEST_F(PlotCommand, PrintsATableAndKeepsTheNumbers) {
    const auto outcome = plot("--csv " + file("t.csv"));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (const char* word : {"experiment", "directions", "rmse", "ldm-50", "ldm-200", "*"})
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word << "\n" << outcome.out;
    const auto kept = Json::parse(read(project_ / "results/plots/directions.json"));
    EXPECT_EQ(kept["study"]["points"].size(), 4u);
    EXPECT_TRUE(kept.contains("key"));
    const auto table = read(file("t.csv"));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
    EXPECT_EQ(run("project " + path() + " --prune").status, 0);
    EXPECT_TRUE(fs::exists(project_ / "results/plots/directions.json"));
}

TEST_F(PlotCommand, ShardsJoinToTheNumbersOfOneMachine) {
    fs::copy(project_, root_ / "one.interreflect", fs::copy_options::recursive);
    ASSERT_EQ(run("plot " + file("one.interreflect") + " directions --quiet").status, 0);
    const auto kept = project_ / "results/plots/directions.json", parts = project_ / "results/plots/parts";
    for (const char* shard : {"3/3", "1/3"}) {
        EXPECT_EQ(plot("directions --shard " + std::string(shard)).status, 0);
        EXPECT_FALSE(fs::exists(kept)) << "shard 2 is missing";
    }
    const auto refused = run("plot merge " + path() + " directions --quiet");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("part 2 of 3 is not there"), std::string::npos) << refused.err;
    const auto last = plot("directions --shard 2/3");
    EXPECT_EQ(last.status, 0) << last.err;
    EXPECT_NE(last.out.find("ldm-200"), std::string::npos) << "it has all points: " << last.out;
    EXPECT_FALSE(fs::exists(parts));
    const auto study = [](const fs::path& file) {
        auto json = Json::parse(read(file))["study"];
        json.erase("notes");  // whether the reference was kept already
        for (auto& point : json["points"])
            for (const char* own : {"ms", "on_front"}) point.erase(own);  // each run has times of its own
        return json;
    };
    EXPECT_EQ(study(kept), study(root_ / "one.interreflect/results/plots/directions.json"));

    // What another state of the project has left does not count.
    EXPECT_EQ(plot("directions --shard 1/2").status, 0);
    json["plots"][0]["values"] = {8, 16, 24};
    store();
    EXPECT_EQ(plot("directions --shard 2/2").status, 0);
    EXPECT_TRUE(fs::exists(parts)) << "the first part is an old one";
    EXPECT_EQ(plot("directions --shard 1/2").status, 0);
    EXPECT_FALSE(fs::exists(parts));
    EXPECT_EQ(study(kept)["points"].size(), 6u);
}

TEST_F(PlotCommand, ShardsWriteTablesOfTheirOwnAndTheLastTheWhole) {
    const auto lines = [&](const std::string& name) {
        const auto text = read(file(name));
        return std::count(text.begin(), text.end(), '\n');
    };
    const auto options = " --csv " + file("t.csv") + " --svg " + file("t.svg");
    EXPECT_EQ(plot("directions --shard 1/2" + options).status, 0);
    EXPECT_FALSE(fs::exists(file("t.csv")) || fs::exists(file("t.svg")));
    EXPECT_EQ(lines("t-1-of-2.csv"), 1 + 2);
    EXPECT_TRUE(fs::exists(file("t-1-of-2.svg")));
    EXPECT_EQ(plot("directions --shard 2/2" + options).status, 0);
    EXPECT_EQ(lines("t.csv"), 1 + 4);
    EXPECT_TRUE(fs::exists(file("t.svg")));
    EXPECT_FALSE(fs::exists(file("t-2-of-2.csv")));
}

/// Nobody else's numbers are overwritten.
TEST_F(PlotCommand, AShardWhosePlotIsRefusedWritesUnderItsOwnName) {
    json["plots"][0]["over"] = "smaples";
    store();
    std::ofstream(file("t.json")) << "whole";
    const auto refused = plot("directions --shard 1/2 --json " + file("t.json"));
    EXPECT_EQ(refused.status, 3) << refused.err;
    EXPECT_EQ(read(file("t.json")), "whole");
    EXPECT_EQ(Json::parse(read(file("t-1-of-2.json"))), Json::object());
}

/// A project goes on being edited while its plots are divided.
TEST_F(PlotCommand, ShardsJoinWhateverPlotsStandBeforeTheirs) {
    EXPECT_EQ(plot("directions --shard 1/2").status, 0);
    auto other = json["plots"][0];
    other["id"] = "other";
    json["plots"].insert(json["plots"].begin(), other);
    store();
    const auto last = plot("directions --shard 2/2");
    EXPECT_EQ(last.status, 0) << last.err;
    const auto kept = Json::parse(read(project_ / "results/plots/directions.json"));
    const auto& points = kept["study"]["points"];
    const auto& values = json["plots"][1]["values"];
    ASSERT_EQ(points.size(), 4u);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(points[i]["value"], values[i % values.size()]) << i;
}

TEST_F(PlotCommand, WhatCannotBeKeptIsToldBeforeAnythingIsRendered) {
    std::ofstream(project_ / "results") << "in the way";
    const auto refused = run("plot " + path());
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("cannot keep results: "), std::string::npos) << refused.err;
    EXPECT_EQ(refused.err.find("samples"), std::string::npos) << "it rendered: " << refused.err;
    EXPECT_EQ(refused.out, "");
}

TEST_F(PlotCommand, PrintsOneJsonObject) {
    const auto outcome = plot("directions --json --no-keep --metric mae");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto all = Json::parse(outcome.out);
    const auto& points = all["directions"]["points"];
    ASSERT_EQ(points.size(), 4u);
    for (const auto& point : points) {
        EXPECT_GT(point["ms"], 0);
        EXPECT_GT(point["errors"]["rmse"], 0);
    }
    EXPECT_FALSE(fs::exists(project_ / "results"));
    const auto bench = run("bench error --json --project " + path());
    ASSERT_EQ(bench.status, 0) << bench.err;
    EXPECT_EQ(Json::parse(bench.out)["directions"]["points"][0]["errors"], points[0]["errors"]);
    EXPECT_NE(run("bench").out.find("error  "), std::string::npos);
}

TEST_F(PlotCommand, RefusesInOneLine) {
    expect_refused("plot " + path() + " nothing", 2, "known are directions");
    expect_refused("plot " + path() + " --metric beauty", 2, "known are rmse");
    expect_refused("plot " + file("nowhere"), 3, "nowhere");
    expect_refused("bench error", 2, "--project");
    expect_refused("sweep " + path() + " nothing --out " + file("out"), 2, "known are directions");
    expect_refused("sweep " + path() + " directions --out " + file("out") + " --shard 3/2", 2, "1/4");
    json["plots"][0]["over"] = "smaples";
    store();
    expect_refused("plot " + path() + " --quiet", 3, "cannot run over 'smaples'");
    json["sweeps"][0]["axes"][0]["values"] = {"many"};
    store();
    expect_refused("sweep " + path() + " directions --out " + file("out"), 3, "directions");
}

TEST_F(PlotCommand, EndsWithTheProjectAtFaultWhereEveryPointIsRefused) {
    json["plots"][0]["values"] = {8, "many"};
    store();
    EXPECT_EQ(plot("").status, 0) << "what is left is a plot";
    json["plots"][0]["values"] = {"many", "none"};
    store();
    const auto outcome = plot("");
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("plot 'directions': no point could be measured; the first: ldm-50: "),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.out.find("ldm-200"), std::string::npos) << "the table says why of each";
}

}  // namespace
}  // namespace ir
