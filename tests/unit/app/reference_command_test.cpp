// `interreflect-cli reference`, `render --keep`, `project --results` and `--changes`: references that grow,
// on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "projects/results.h"
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

/// A small project with one experiment that has no reference.
class ReferenceCommand : public testing::Test {
  protected:
    ReferenceCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = fs::temp_directory_path() / ("interreflect-reference-" + std::string(test->name()));
        fs::remove_all(root_);
        auto json = Json::parse(
            read(fs::path(SOURCE_ROOT) / "projects/samples/crevice-leaks.interreflect/project.json"));
        json["experiments"].erase(json["experiments"].begin() + 1, json["experiments"].end());
        json["comparisons"] = json["sweeps"] = Json::array();
        json.erase("plots");
        for (const char* key : {"reference", "presets", "active_preset"}) json["experiments"][0].erase(key);
        json["experiments"][0]["size"] = {16, 12};
        id = json["experiments"][0]["id"];
        make("p", json);
        make("q", json);
    }
    ~ReferenceCommand() override { fs::remove_all(root_); }

    fs::path project(const std::string& name) const { return root_ / (name + ".interreflect"); }
    void make(const std::string& name, const Json& json) const {
        fs::create_directories(project(name));
        std::ofstream(project(name) / "project.json") << json.dump(2);
    }
    Json document(const std::string& name) const { return Json::parse(read(project(name) / "project.json")); }
    Outcome run(const std::string& arguments) const { return run_program(arguments, root_); }
    Json reference(const std::string& name, const std::string& flags) const {
        const auto outcome = run("reference " + project(name).string() + " --json " + flags);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out).at("references");
    }
    Image picture(const std::string& name, const std::string& key) const {
        const auto index = projects::ResultIndex::load(project(name));
        return read_image(project(name) / "results" / projects::file_of(*index.find(key), "main")->path);
    }

    fs::path root_;
    std::string id;
};

TEST_F(ReferenceCommand, MatchesKeepsAndGrowsToTheSameBitsAsAtOnce) {
    const auto first = reference("p", "--samples 64").at(0);
    const auto samples = first["samples"].get<int>(), more = samples + 99;
    EXPECT_EQ(samples, 64) << "a new reference has what was asked for";
    auto now = document("p");
    ASSERT_EQ(now["experiments"].size(), 2u);
    EXPECT_EQ(now["experiments"][0]["reference"], first["experiment"]);
    EXPECT_EQ(projects::ResultIndex::load(project("p")).last_kept().at(first["experiment"]), first["key"]);

    const auto grown = reference("p", "--samples " + std::to_string(more)).at(0);
    EXPECT_EQ(grown["resumed_from"], samples);
    EXPECT_EQ(grown["samples"], more);
    EXPECT_EQ(grown["experiment"], first["experiment"]);
    const auto at_once = reference("q", "--samples " + std::to_string(more)).at(0);
    EXPECT_EQ(at_once["resumed_from"], 0);
    EXPECT_EQ(at_once["key"], grown["key"]);
    EXPECT_EQ(picture("p", grown["key"]).pixels, picture("q", at_once["key"]).pixels);

    // Again: nothing is traced, nothing changes.
    const auto before = read(project("p") / "results/index.json");
    const auto again = reference("p", "").at(0);
    EXPECT_EQ(again["resumed_from"], more);
    EXPECT_EQ(again["samples"], more);
    EXPECT_EQ(read(project("p") / "results/index.json"), before);
    const auto text = run("reference " + project("p").string());
    EXPECT_NE(text.out.find(std::to_string(more) + " samples are kept already"), std::string::npos)
        << text.out;
}

TEST_F(ReferenceCommand, RenderGoesOnFromAKeptStateToo) {
    const auto first = reference("p", "").at(0);
    auto json = document("p");
    json["experiments"][1]["frames"] = 2;
    make("p", json);
    const std::string truth = first["experiment"];
    const auto render = "render " + project("p").string() + " --keep --quiet --experiment " + truth +
                        " --out " + (root_ / "out").string();
    ASSERT_EQ(run(render).status, 0);
    // The picture with more samples stands for the one with fewer, and says so.
    const auto results =
        Json::parse(run("project " + project("p").string() + " --results --json").out).at("results");
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[1]["state"], "current");
    EXPECT_EQ(results[1]["samples"], first["samples"]);
    const auto changes = Json::parse(
        run("project " + project("p").string() + " --json --changes " + truth + " now:" + truth).out);
    EXPECT_NE(changes["inputs"].dump().find("frames: "), std::string::npos) << changes;
    // A damaged state is a warning; the picture is traced anew.
    const auto index = projects::ResultIndex::load(project("p"));
    for (const auto& entry : index.entries())
        if (const auto* file = projects::file_of(entry, "state"))
            std::ofstream(project("p") / "results" / file->path) << "damaged";
    const auto outcome = run(render);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("a kept state is not continued"), std::string::npos) << outcome.err;
}

TEST_F(ReferenceCommand, ResultsAndChangesAreListed) {
    EXPECT_EQ(run("project " + project("p").string() + " --results").out, "no kept results\n");
    const std::string truth = reference("p", "").at(0)["experiment"];
    const auto row =
        Json::parse(run("project " + project("p").string() + " --results --json").out)["results"][0];
    EXPECT_EQ(row["experiment"], truth);
    EXPECT_EQ(row["method"], "reference");
    EXPECT_NE(run("project " + project("p").string() + " --results").out.find(truth + "  reference  "),
              std::string::npos);
    EXPECT_EQ(row["state"], "current");
    EXPECT_TRUE(row["can_continue"]);
    const auto key = row["key"].get<std::string>().substr(0, 6);
    auto json = document("p");
    json["experiments"][1]["seed"] = 77;
    make("p", json);
    const auto changes = run("project " + project("p").string() + " --changes " + key);
    EXPECT_EQ(changes.status, 0) << changes.err;
    EXPECT_NE(changes.out.find("seed: 1 → 77"), std::string::npos) << changes.out;
    EXPECT_EQ(run("project " + project("p").string() + " --changes nothing").status, 2);
    EXPECT_EQ(run("project " + project("p").string() + " --changes " + id).status, 2)
        << "nothing is kept of it";
}

TEST_F(ReferenceCommand, RefusesWhatCannotBeMatched) {
    EXPECT_EQ(run("reference " + project("p").string() + " --experiment nobody").status, 2);
    EXPECT_EQ(run("reference " + project("none").string()).status, 3);
    EXPECT_EQ(run("reference " + project("p").string() + " --samples 0").status, 2);
    auto json = document("p");
    json["experiments"][0]["method"] = "teleport";
    make("p", json);
    const auto outcome = run("reference " + project("p").string());
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(ReferenceCommand, OneLineRendersTheTruthOfAPicture) {
    const auto out = (root_ / "truth.exr").string();
    const auto outcome =
        run("render --scene builtin:cornell --method ldm-ao --set max_distance=0.5 --match "
            "--samples 24 --size 16x12 --quiet --out " +
            out);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ImageAttributes attributes;
    read_exr(out, &attributes);
    EXPECT_EQ(attributes.at("interreflect.set.max_distance"), "0.5");
    EXPECT_EQ(attributes.at("interreflect.samples"), "24");
    EXPECT_EQ(run("render --scene builtin:cornell --method ldm-ao --samples 4 --out " + out).status, 2);
}

}  // namespace
}  // namespace ir
