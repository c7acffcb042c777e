// `interreflect-cli reference`, `render --keep`, `project --results` and `--changes`: references that grow,
// on the real program.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/engine/stored_state.h"
#include "projects/results.h"
#include "renderers/image/exr.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

/// A small project with one experiment that has no reference.
class ReferenceCommand : public testing::Test {
  protected:
    ReferenceCommand() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root_ = own_folder("reference-" + std::string(test->name()));
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

/// A picture of several tiles, with light that is traced from its sources.
class DividedReference : public ReferenceCommand {
  protected:
    DividedReference() {
        const Json json{{"schema", 6},
                        {"name", "Caustics"},
                        {"scenes", {{{"id", "c"}, {"parts", {{{"source", "builtin:caustics"}}}}}}},
                        {"experiments",
                         {{{"id", "a"}, {"scene", "c"}, {"method", "photon-mapping"}, {"size", {50, 40}}}}}};
        for (const char* name : {"p", "q"}) make(name, json);
    }

    Json shard(const std::string& name, const std::string& shard, const std::string& flags) const {
        return reference(name, "--quiet --shard " + shard + " " + flags);
    }
    fs::path parts(const std::string& name) const { return project(name) / "results/parts"; }

    /// Picture, and state to go on from, of what p and q keep by these keys.
    void expect_same_bits(const Json& divided_key, const Json& whole_key) const {
        EXPECT_EQ(picture("p", divided_key).pixels, picture("q", whole_key).pixels);
        const auto state = [&](const std::string& name, const std::string& key) {
            const auto index = projects::ResultIndex::load(project(name));
            return engine::load_state(project(name) / "results" /
                                      projects::file_of(*index.find(key), projects::state_role)->path);
        };
        const auto divided = state("p", divided_key), whole = state("q", whole_key);
        EXPECT_EQ(divided.samples, whole.samples);
        EXPECT_EQ(divided.fingerprint, whole.fingerprint);
        ASSERT_EQ(divided.history.entries.size(), whole.history.entries.size());
        for (std::size_t i = 0; i < whole.history.entries.size(); ++i) {
            EXPECT_EQ(divided.history.entries[i].key, whole.history.entries[i].key);
            EXPECT_TRUE(divided.history.entries[i].bytes == whole.history.entries[i].bytes)
                << whole.history.entries[i].key;
        }
    }
};

TEST_F(DividedReference, ShardsJoinToTheBitsOfOneMachine) {
    const auto whole = reference("q", "--quiet --samples 10").at(0);
    EXPECT_EQ(shard("p", "2/3", "--samples 10").size(), 1u);
    EXPECT_EQ(shard("p", "3/3", "--samples 4").at(0)["samples"], 4) << "as if it had been interrupted";
    EXPECT_EQ(shard("p", "1/3", "--samples 10").size(), 1u);
    EXPECT_FALSE(fs::exists(project("p") / "results/index.json")) << "part 3 is not complete";
    const auto last = shard("p", "3/3", "--samples 10");
    ASSERT_EQ(last.size(), 2u) << "whoever ends last joins them";
    EXPECT_EQ(last[0]["resumed_from"], 4);
    EXPECT_FALSE(fs::exists(parts("p")));
    expect_same_bits(last[1]["key"], whole["key"]);

    // One machine goes on from there, and shards that are run again find it kept.
    EXPECT_EQ(shard("p", "2/3", "--samples 10").at(0)["resumed_from"], 10);
    const auto more = reference("p", "--quiet --samples 17").at(0);
    EXPECT_EQ(more["resumed_from"], 10);
    expect_same_bits(more["key"], reference("q", "--quiet --samples 17").at(0)["key"]);
}

TEST_F(DividedReference, MergeJoinsWhatOtherMachinesMade) {
    const auto whole = reference("q", "--quiet --samples 6").at(0);
    fs::copy(project("p"), project("r"), fs::copy_options::recursive);
    const auto merge = "reference merge " + project("p").string() + " --quiet --json";
    const auto refused = [&](const std::string& part) {
        const auto outcome = run(merge);
        EXPECT_EQ(outcome.status, 1) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    };
    refused("no part of it is there");
    shard("p", "1/2", "--samples 6");
    refused("part 2 of 2 is not there");
    shard("r", "2/2", "--samples 6");
    for (const auto& part : fs::directory_iterator(parts("r"))) fs::copy(part, parts("p"));
    const auto outcome = run(merge);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["references"][0]["key"], whole["key"]);
    expect_same_bits(whole["key"], whole["key"]);
    EXPECT_EQ(run(merge).status, 0) << "again: it is kept";
}

TEST_F(DividedReference, DamagedPartsAreComputedAgain) {
    const auto whole = reference("q", "--quiet --samples 6").at(0);
    shard("p", "1/2", "--samples 6");
    for (const auto& part : fs::directory_iterator(parts("p"))) std::ofstream(part.path()) << "damaged";
    const auto outcome = run("reference " + project("p").string() + " --quiet --samples 6 --shard 1/2");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("a part of the picture is not continued"), std::string::npos) << outcome.err;
    EXPECT_EQ(shard("p", "2/2", "--samples 6").size(), 2u);
    expect_same_bits(whole["key"], whole["key"]);
    EXPECT_EQ(run("reference " + project("p").string() + " --shard 0/2").status, 2);
    EXPECT_EQ(run("reference").status, 2);
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
    const auto unknown = run("reference " + project("p").string() + " --experiment nobody");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("there is no experiment 'nobody' in the project; known are "),
              std::string::npos)
        << unknown.err;
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
