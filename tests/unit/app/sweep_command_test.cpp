// `interreflect-cli sweep` and `sweep merge`: judged, timed, resumed, divided, on the real program.
#include <gtest/gtest.h>

#include <chrono>

#include "renderers/image/exr.h"
#include "renderers/image/metrics.h"
#include "tests/child_process.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

using Variables = std::map<std::string, std::string>;

class SweepCommand : public CommandTest {
  protected:
    void SetUp() override {
        CommandTest::SetUp();
        json_ = {{"schema", 6},
                 {"name", "Small"},
                 {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell@1"}}}}}}},
                 {"experiments",
                  {{{"id", "a"},
                    {"scene", "box"},
                    {"method", "ldm-ao"},
                    {"values", {{"directions", 8}}},
                    {"transport", {{"max_distance", 0.5}}},
                    {"size", {16, 12}}},
                   {{"id", "b"}, {"scene", "box"}, {"method", "hbao"}, {"size", {8, 8}}}}},
                 {"sweeps",
                  {{{"id", "s"}, {"experiment", "a"}, {"axes", {axis("directions", {8, 16, 24})}}},
                   {{"id", "other"}, {"experiment", "a"}, {"axes", {axis("seed", {1, 2})}}}}}};
        store();
    }

    static Json axis(const std::string& key, const Json& values) {
        return {{"key", key}, {"values", values}};
    }
    void store() const {
        fs::create_directories(project());
        std::ofstream(project() + "/project.json") << json_.dump(2);
    }
    std::string project() const { return file("p.interreflect"); }
    std::string command(const std::string& out, const std::string& flags = "") const {
        return "sweep " + project() + " s --quiet --out " + file(out) + " " + flags;
    }
    void sweep(const std::string& out, const std::string& flags = "") const { output(command(out, flags)); }
    Json list(const std::string& name) const { return Json::parse(read(file(name))); }
    static std::vector<std::string> lines_of(const std::string& text) {
        std::vector<std::string> lines;
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
        return lines;
    }
    /// Without what no two runs share.
    static Json without_times(Json list) {
        for (auto& point : list["points"]) {
            for (const char* key : {"cold_ms", "warm_ms"}) point.erase(key);
            auto& counters = point["counters"];
            // Times, and how many maps threads happened to hold at once.
            const auto is_chance = [](const std::string& key) {
                return key.find("ms") != std::string::npos || key.find("second") != std::string::npos ||
                       key == "ldm.bytes";
            };
            for (auto it = counters.begin(); it != counters.end();)
                it = is_chance(it.key()) ? counters.erase(it) : std::next(it);
        }
        return list;
    }

    Json json_;
};

TEST_F(SweepCommand, MeasuresAndTimesEveryVariation) {
    sweep("out", "--reference 16 --csv " + file("t.csv"));
    const auto points = list("out/sweep.json")["points"];
    ASSERT_EQ(points.size(), 3u);
    for (const auto& point : points) {
        for (const auto& metric : metric_names()) EXPECT_TRUE(point["errors"].contains(metric)) << metric;
        EXPECT_GT(point["errors"]["rmse"], 0);
        EXPECT_GT(point["reference_noise"], 0);
        EXPECT_GT(point["cold_ms"], 0);
        EXPECT_GT(point["warm_ms"], 0);
        EXPECT_GT(point["memory_bytes"], 0);
        EXPECT_FALSE(point["counters"].empty());
        EXPECT_FALSE(point.contains("image"));
        EXPECT_EQ(point["reference"], points[0]["reference"]) << "directions are no transport";
    }
    EXPECT_LT(points[2]["errors"]["rmse"], points[0]["errors"]["rmse"]) << "24 directions against 8";
    EXPECT_FALSE(fs::exists(file("out/a-0001.exr")));
    EXPECT_FALSE(fs::exists(file("p.interreflect/results"))) << "a sweep changes no project";

    const auto lines = lines_of(read(file("out/sweep.jsonl")));
    ASSERT_EQ(lines.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(Json::parse(lines[i]), points[i]);

    // Whoever gets the folder, or a report of it, is told how the ground truth was made.
    const auto truth = points[0]["reference"].get<std::string>();
    auto made = read_exr_attributes(file("out/references/" + truth + ".exr"));
    EXPECT_EQ(made["interreflect.method"], "reference");
    EXPECT_EQ(made["interreflect.samples"], "16");
    EXPECT_NE(made["interreflect.device"], "");

    const auto rows = lines_of(read(file("t.csv")));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].rfind("id,directions,cold_ms,warm_ms,", 0), 0u) << rows[0];
    EXPECT_EQ(rows[3].rfind("a-0003,24,", 0), 0u) << rows[3];

    sweep("out", "--reference 16 --resume");
    EXPECT_EQ(lines_of(read(file("out/sweep.jsonl"))), lines) << "nothing was left to do";
}

TEST_F(SweepCommand, ErrorsAreThoseThatCompareFinds) {
    json_["sweeps"][0]["axes"][0]["values"] = {8};
    store();
    sweep("out", "--reference 16 --keep --repeats 0");
    const auto point = list("out/sweep.json")["points"][0];
    EXPECT_FALSE(point.contains("warm_ms"));
    const auto truth =
        Json::parse(output("reference " + project() + " --experiment a --samples 16 --json --quiet --out " +
                           file("truth")))["references"][0]["experiment"];
    const auto errors = Json::parse(output("compare " + file("out/a-0001.exr") + " " +
                                           file("truth/" + truth.get<std::string>() + ".exr") +
                                           " --metric rmse,ssim --json"))["metrics"];
    EXPECT_EQ(point["errors"]["rmse"], errors["rmse"]);
    EXPECT_EQ(point["errors"]["ssim"], errors["ssim"]);
}

TEST_F(SweepCommand, AVariationThatFailsIsARow) {
    json_["scenes"].push_back({{"id", "gone"}, {"parts", {{{"source", "gone.gltf"}}}}});
    json_["sweeps"][0]["axes"][0] = axis("scene", {"gone", "box"});
    store();
    const auto outcome = run(command("out", "--reference 1 --repeats 0"));
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("a-0001: "), std::string::npos) << outcome.err;
    const auto points = list("out/sweep.json")["points"];
    EXPECT_NE(points[0]["problem"].get<std::string>().find("gone.gltf"), std::string::npos);
    EXPECT_GT(points[1]["errors"]["rmse"], 0);
    EXPECT_EQ(lines_of(read(file("out/sweep.jsonl"))).size(), 2u);
}

TEST_F(SweepCommand, ResumesWhatWasKilled) {
    // The second never ends.
    json_["experiments"][0] = {{"id", "a"}, {"scene", "box"}, {"method", "reference"}, {"size", {16, 12}}};
    json_["sweeps"][0]["axes"][0] = axis("samples", {2, 1'000'000, 4});
    store();
    const auto lines = [&] { return lines_of(read(file("out/sweep.jsonl"))); };
    {
        ChildProcess child(CLI_PROGRAM, {"sweep", project(), "s", "--out", file("out")}, folder_ / "child");
        ASSERT_TRUE(child.reaches([&] { return lines().size() == 1; })) << child.err();
        child.send(SIGKILL);
        child.wait();
    }
    const auto first = lines()[0];
    std::ofstream(file("out/sweep.jsonl"), std::ios::app) << "{\"id\": \"a-00";  // killed while it wrote
    json_["sweeps"][0]["axes"][0]["values"][1] = 3;
    store();
    sweep("out", "--resume");
    sweep("whole");
    EXPECT_EQ(without_times(list("out/sweep.json")), without_times(list("whole/sweep.json")));
    for (const std::string picture : {"/a-0001.exr", "/a-0002.exr", "/a-0003.exr"})
        EXPECT_EQ(read(file("out" + picture)), read(file("whole" + picture))) << picture;
    const auto resumed = lines();
    ASSERT_EQ(resumed.size(), 3u);
    EXPECT_EQ(resumed[0], first) << "was not rendered again";

    // What has lost its picture, or would be another one now, is rendered; nothing else.
    fs::remove(file("out/a-0003.exr"));
    json_["sweeps"][0]["axes"][0]["values"][0] = 1;
    store();
    sweep("out", "--resume");
    const auto again = lines();
    ASSERT_EQ(again.size(), 3u);
    EXPECT_EQ(again[0], resumed[1]) << "the lines that were there come first";
    EXPECT_EQ(Json::parse(again[1])["coordinates"]["samples"], 1);
    EXPECT_TRUE(fs::exists(file("out/a-0003.exr")));
}

TEST_F(SweepCommand, GoingOnWithoutAReferenceKeepsErrors) {
    sweep("out", "--reference 4 --keep");
    const auto before = list("out/sweep.json");
    EXPECT_TRUE(before["points"][0].contains("errors"));
    fs::remove(file("out/" + before["points"][1]["image"].get<std::string>()));
    sweep("out", "--resume");
    const auto after = list("out/sweep.json");
    EXPECT_EQ(after["points"][0], before["points"][0]);
    EXPECT_FALSE(after["points"][1].contains("errors")) << "was rendered again, unjudged";
}

TEST_F(SweepCommand, ShardsJoinToWhatOneMachineMakes) {
    sweep("one", "--reference 4 --keep --repeats 0");
    sweep("first", "--reference 4 --keep --repeats 0 --shard 1/2");
    for (const auto& [name, value] : Variables{{"ID", "11"}, {"MIN", "10"}, {"COUNT", "2"}})
        ::setenv(("SLURM_ARRAY_TASK_" + name).c_str(), value.c_str(), 1);
    sweep("second", "--reference 4 --keep --repeats 0 --shard-from-env");
    for (const char* name : {"ID", "MIN", "COUNT"})
        ::unsetenv(("SLURM_ARRAY_TASK_" + std::string(name)).c_str());
    output("sweep merge " + file("second") + " " + file("first") + " --out " + file("all.json") + " --csv " +
           file("all.csv"));

    auto merged = list("all.json");
    for (std::size_t i = 0; i < 3; ++i) {
        auto& point = merged["points"][i];
        const auto id = point["id"].get<std::string>();
        EXPECT_EQ(point["image"], (i == 1 ? "second/" : "first/") + id + ".exr");
        EXPECT_EQ(read(file(point["image"])), read(file("one/" + id + ".exr"))) << "bit for bit";
        point["image"] = id + ".exr";
    }
    EXPECT_EQ(without_times(merged), without_times(list("one/sweep.json")));
    EXPECT_EQ(lines_of(read(file("all.csv"))).size(), 4u);

    // One machine goes on where a shard ended.
    sweep("first", "--reference 4 --keep --repeats 0 --resume");
    const auto whole = list("first/sweep.json");
    EXPECT_EQ(without_times(whole), without_times(list("one/sweep.json")));
    EXPECT_EQ(whole["points"][0], list("first/sweep-1-of-2.json")["points"][0]) << "times, too: it was kept";
}

TEST_F(SweepCommand, MergeRefusesInOneLine) {
    const auto merge = [&](const std::string& folders) {
        return "sweep merge " + folders + " --out " + file("all.json");
    };
    const auto list_of = [&](const std::string& name, int index, int count, const std::string& sweep,
                             const std::string& plan, std::size_t rows) {
        Json list{{"sweep", sweep}, {"experiment", "a"}, {"plan", plan}, {"shard", index}, {"shards", count}};
        list["points"] = Json::array();
        for (std::size_t i = 0; i < rows; ++i)
            list["points"].push_back({{"id", "a-" + std::to_string(i)}, {"coordinates", Json::object()}});
        fs::create_directories(file(name));
        std::ofstream(file(name) + "/sweep-" + std::to_string(index) + "-of-" + std::to_string(count) +
                      ".json")
            << list.dump();
        return file(name);
    };
    const auto first = list_of("1", 1, 2, "s", "p", 2), second = list_of("2", 2, 2, "s", "p", 1);
    expect_refused(merge(first), 3, "shard 2 of 2 is in none of the folders");
    expect_refused(merge(first + " " + first), 3, "is the same shard as");
    expect_refused(merge(first + " " + list_of("other", 2, 2, "t", "p", 1)), 3, "'t' and 's'");
    expect_refused(merge(first + " " + list_of("old", 2, 2, "s", "q", 1)), 3, "the project or --reference");
    expect_refused(merge(first + " " + list_of("fine", 2, 3, "s", "p", 1)), 3,
                   "one of 3, the other one of 2");
    expect_refused(merge(first + " " + list_of("short", 2, 2, "s", "p", 0)), 3, "sweep-2-of-2.json: /points");
    expect_refused(merge(file("nowhere")), 3, "nowhere: is no folder");
    fs::create_directories(file("empty"));
    expect_refused(merge(file("empty")), 3, "empty: has no list of a sweep");
    std::ofstream(file("empty/sweep.json")) << "{";
    expect_refused(merge(file("empty")), 3, "sweep.json: line 1");
    expect_refused("sweep merge --out " + file("all.json"), 2, "DIR is required");
    expect_refused("sweep merge " + first + " " + second + " --out " + first + "/sweep-1-of-2.json", 2,
                   "is the file of DIR");
    std::ofstream(first + "/sweep-0001.json") << "{}";  // statistics of an experiment "sweep"
    EXPECT_EQ(run(merge(first + " " + second)).status, 0);
    expect_refused("sweep " + project(), 2, "is required");
}

TEST_F(SweepCommand, RefusesInOneLine) {
    for (const char* option : {"--csv ", "--json "})
        expect_refused(command("out", option + file("nowhere/list")), 2, "nowhere");
    expect_refused(command("out", "--shard 0/2"), 2, "--shard '0/2': give I/N with I from 1 to N");
    for (const char* shard : {"3/2", "1/0", "1", "a/2", "1/2/3"})
        expect_refused(command("out", "--shard " + std::string(shard)), 2, "the first shard is 1, not 0");
    expect_refused(command("out", "--shard-from-env"), 2, "SLURM_ARRAY_TASK_ID is not set");
    expect_refused(command("out", "--shard-from-env --shard 1/2"), 2, "not both");
    expect_refused(command("out", "--reference 0"), 2, "--reference '0'");
    sweep("out", "--shard 3/3");
    expect_refused("sweep " + project() + " other --quiet --resume --out " + file("out"), 3,
                   "sweep-3-of-3.json: is of sweep 's'");
}

TEST_F(SweepCommand, ProjectsAreRenderedInShards) {
    const auto rendered = [&](const std::string& shard) {
        output("render " + project() + " --quiet --shard " + shard + " --out " +
               file("out" + shard.substr(0, 1)));
    };
    rendered("1/2");
    rendered("2/2");
    EXPECT_TRUE(fs::exists(file("out1/a.exr")) && !fs::exists(file("out1/b.exr")));
    EXPECT_TRUE(fs::exists(file("out2/b.exr")) && !fs::exists(file("out2/a.exr")));
    expect_refused("render --scene builtin:cornell --method hbao --shard 1/2 --out " + file("x.exr"), 2,
                   "--shard cannot be used without a PROJECT");
    for (const char* id : {"p", "q"})
        json_["plots"].push_back({{"id", id},
                                  {"reference", "b"},
                                  {"experiments", {"b"}},
                                  {"over", "frames"},
                                  {"values", {1}},
                                  {"metric", "rmse"}});
    store();
    std::map<std::string, int> shards;  // that have the plot's only point
    for (const char* shard : {"1/2", "2/2"}) {
        const auto outcome = run("plot " + project() + " --quiet --no-keep --json --shard " + shard);
        const auto plots = Json::parse(outcome.out);
        for (const std::string id : {"p", "q"})
            shards[id] += plots.contains(id) || outcome.err.find("plot '" + id + "'") != std::string::npos;
    }
    EXPECT_EQ(shards["p"], 1);
    EXPECT_EQ(shards["q"], 1);
}

TEST_F(SweepCommand, PlansWithAFewVariationsWhatAllTake) {
    json_["sweeps"][0]["axes"] = {axis("directions", {8, 16, 32, 64}), axis("size", {{32, 24}, {64, 48}}),
                                  axis("seed", {1, 2})};
    store();
    const auto plan =
        Json::parse(output("sweep plan " + project() + " s --quiet --reference 4 --keep --json"));
    EXPECT_EQ(plan["variations"], 16);
    EXPECT_EQ(plan["measured"], 8);
    EXPECT_GT(plan["memory_bytes"], 0);
    EXPECT_GT(plan["references_seconds"], 0);
    const auto start = std::chrono::steady_clock::now();
    sweep("out", "--reference 4 --keep");
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    // Other work on the machine meanwhile counts, too.
    EXPECT_LT(plan["seconds"], 4 * taken.count());
    EXPECT_GT(plan["seconds"], taken.count() / 4);
    double bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(file("out")))
        if (entry.is_regular_file() && entry.path().filename().string().find("sweep") != 0)
            bytes += static_cast<double>(entry.file_size());
    EXPECT_NEAR(plan["disk_bytes"].get<double>() / bytes, 1, 0.3);
    const auto text = output("sweep plan " + project() + " s --quiet --probes 3");
    EXPECT_EQ(text.rfind("16 variations, 3 measured in ", 0), 0u) << text;
    expect_refused("sweep plan " + project() + " nothing", 2, "known are s, other");
    expect_refused("submit --tasks 2 sweep plan " + project() + " s", 2, "run it before the tasks");
}

TEST_F(SweepCommand, ShardsWriteTablesOfTheirOwn) {
    for (const char* shard : {"1/2", "2/2"})
        sweep("out",
              "--shard " + std::string(shard) + " --csv " + file("t.csv") + " --json " + file("l.json"));
    EXPECT_FALSE(fs::exists(file("t.csv")));
    EXPECT_EQ(lines_of(read(file("t-1-of-2.csv"))).size(), 1u + 2);
    EXPECT_EQ(lines_of(read(file("t-2-of-2.csv"))).size(), 1u + 1);
    EXPECT_EQ(list("l-2-of-2.json")["points"].size(), 1u);
}

TEST_F(SweepCommand, GoesToWhereTheWindowLooksForIt) {
    output("sweep " + project() + " s --quiet --out " + project() + "/results/sweeps/s");
    EXPECT_EQ(list("p.interreflect/results/sweeps/s/sweep.json")["points"].size(), 3u);
    expect_refused("sweep " + project() + " s --quiet --out " + project() + "/results/s", 2, "project");
}

}  // namespace
}  // namespace ir
