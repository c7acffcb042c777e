// `interreflect-cli bench`: the table, its files, statuses, on the real program.
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

class BenchCommand : public testing::Test {
  protected:
    BenchCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("bench-" + std::string(test->name()));
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    ~BenchCommand() override { fs::remove_all(root_); }

    Outcome bench(const std::string& arguments) { return run_program("bench " + arguments, root_); }
    /// The smallest method on a small scene.
    Outcome tiny(const std::string& flags) {
        return bench("view-normals-defaults --scene builtin:cornell --size 16x12 --repeats 1 " + flags);
    }
    void expect_refused(const std::string& arguments, int status, const std::string& part) {
        const auto outcome = bench(arguments);
        EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.out.empty());
    }

    fs::path root_;
};

TEST_F(BenchCommand, TextBeginsWithTheTable) {
    const auto file = (root_ / "t.csv").string();
    const auto outcome = tiny("--csv " + file);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("Variant   Total [ms]   Memory [")) << outcome.out;
    EXPECT_NE(outcome.out.find("\ndefaults  "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("warm_ms: "), std::string::npos) << "all numbers come after it";
    const auto table = read(file);
    EXPECT_TRUE(table.starts_with("variant,Total [ms],Memory [B],problem\r\ndefaults,")) << table;
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2);
}

TEST_F(BenchCommand, JsonHasTheTableBesideAllNumbers) {
    const auto outcome = tiny("--json");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = Json::parse(outcome.out);
    for (const char* key :
         {"benchmark", "method", "device", "software", "repeats", "results", "columns", "table"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["results"]["size"], Json({16, 12}));
    EXPECT_EQ(json["results"]["scene"], "builtin:cornell");
    const auto& variant = json["results"]["variants"][0];
    for (const char* key :
         {"cold_wall_ms", "cold_ms", "warm_ms", "passes", "memory_bytes", "counters", "label"})
        EXPECT_TRUE(variant.contains(key)) << key;
    EXPECT_EQ(json["columns"][0]["label"], "Total");
    EXPECT_EQ(json["columns"][0]["unit"], "ms");
    EXPECT_EQ(json["table"][0]["label"], "defaults");
    EXPECT_EQ(json["table"][0]["cells"][0], variant["warm_ms"]);
    EXPECT_EQ(json["table"][0]["cells"][1], variant["memory_bytes"]);
}

TEST_F(BenchCommand, AVariantWithoutMemoryIsARow) {
    const auto outcome = tiny("--memory 1kB --json");
    EXPECT_EQ(outcome.status, 1) << "nothing could be measured";
    const auto json = Json::parse(outcome.out);
    const std::string problem = json["table"][0]["problem"];
    EXPECT_NE(problem.find("memory budget"), std::string::npos) << problem;
    EXPECT_TRUE(json["table"][0]["cells"][0].is_null());
    EXPECT_NE(outcome.err.find("defaults: " + problem), std::string::npos) << outcome.err;
}

TEST_F(BenchCommand, RefusesInOneLine) {
    expect_refused("nonsense", 2, "known are ");
    expect_refused("view-normals-defaults --variant fast", 2, "known are defaults");
    expect_refused("view-normals-defaults --size 12", 2, "--size");
    expect_refused("view-normals-defaults --scene " + (root_ / "none.glb").string(), 3, "none.glb");
    expect_refused("error --project x --csv y", 2, "do not belong");
    expect_refused("view-normals-defaults --scene builtin:cornell --scene builtin:furnace", 2,
                   "more than once");
    expect_refused("defaults --csv y", 2, "--csv");
    expect_refused("defaults --variant view-normals", 2, "can judge none");
    expect_refused("defaults --scene " + (root_ / "none.glb").string(), 3, "none.glb");
}

TEST_F(BenchCommand, DefaultsHaveATableForEachSceneAndTransport) {
    const std::string tiny_defaults =
        "defaults --variant hbao --variant ssdo --scene builtin:cornell --scene builtin:furnace --size 16x12 "
        "--repeats 1 ";
    const auto text = bench(tiny_defaults);
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_TRUE(text.out.starts_with("builtin:cornell, 16x12, paths=ao max_distance=1, ")) << text.out;
    EXPECT_NE(text.out.find("\n\nbuiltin:furnace, 16x12, paths=full max_distance=1, "), std::string::npos);
    EXPECT_NE(text.out.find("\nhbao  "), std::string::npos) << text.out;
    const auto json = bench(tiny_defaults + "--json");
    ASSERT_EQ(json.status, 0) << json.err;
    const auto tables = Json::parse(json.out)["tables"];
    ASSERT_EQ(tables.size(), 4u);
    EXPECT_EQ(tables[0]["results"]["scene"], "builtin:cornell");
    EXPECT_EQ(tables[3]["results"]["scene"], "builtin:furnace");
    EXPECT_EQ(tables[0]["table"][1]["label"], "hbao");
    EXPECT_EQ(tables[1]["table"][1]["label"], "ssdo");
    EXPECT_EQ(tables[1]["table"][1]["cells"].size(), tables[1]["columns"].size());
}

TEST_F(BenchCommand, ListsWhatThereIs) {
    const auto outcome = bench("--json");
    ASSERT_EQ(outcome.status, 0);
    const auto list = Json::parse(outcome.out);
    EXPECT_TRUE(std::any_of(list.begin(), list.end(),
                            [](const auto& each) { return each["name"] == "view-normals-defaults"; }));
    EXPECT_TRUE(
        std::any_of(list.begin(), list.end(), [](const auto& each) { return each["name"] == "defaults"; }));
    for (const auto& each : list) EXPECT_FALSE(each["doc"].get<std::string>().empty());
}

}  // namespace
}  // namespace ir
