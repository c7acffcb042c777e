#include "projects/keep.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "projects/changes.h"
#include "projects/hash.h"
#include "projects/samples.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::sample_project;
using testing::TemporaryFolder;

/// Method "fog", whose samples add up.
const Registry& accumulating() {
    static const MethodDescription fog = [] {
        auto method = testing::registry().at("fog");
        for (auto& parameter : method.parameters)
            if (parameter.key == "samples") parameter.accumulates = true;
        return method;
    }();
    static const Registry all({&fog, &testing::registry().at("plain")});
    return all;
}

std::string key_of_state(const Project& project) {
    return state_key(project, project.experiments[0], accumulating());
}

TEST(StateKey, DoesNotDependOnTheNumberOfSamples) {
    const auto before = key_of_state(sample_project());
    auto project = sample_project();
    project.experiments[0].frames = 9;
    EXPECT_EQ(key_of_state(project), before);
    project.experiments[0].presets["paper"].values["samples"] = std::int64_t{2};
    EXPECT_EQ(key_of_state(project), before);
    project.experiments[0].seed = 8;
    EXPECT_NE(key_of_state(project), before);
    project = sample_project();
    project.experiments[0].values["density"] = 3.0;
    EXPECT_NE(key_of_state(project), before);
    project = sample_project();
    EXPECT_NE(state_key(project, project.experiments[0], testing::registry()), before)
        << "a parameter that does not accumulate is part of the key";
}

TEST(SampleCount, IsFramesTimesSamples) {
    const auto project = sample_project();
    EXPECT_EQ(sample_count(project.experiments[0], accumulating()), 4u * 256);
    EXPECT_EQ(sample_count(project.experiments[1], accumulating()), 1u);
    EXPECT_EQ(sample_count(project.experiments[0], testing::registry()), 4u);
}

TEST(SampleCount, CanBeSetExactly) {
    auto project = sample_project();
    for (const std::uint64_t samples : {1u, 2u, 64u, 97u, 100u, 1024u, 4096u, 5000u}) {
        const auto after = with_sample_count(project.experiments[0], samples, accumulating());
        EXPECT_EQ(sample_count(after, accumulating()), samples);
        EXPECT_EQ(after.values, project.experiments[0].values) << "the preset overrides them";
        project.experiments[0] = after;
        EXPECT_EQ(key_of_state(project), key_of_state(sample_project()));
    }
    // Samples are at most 4096 in a frame here, and the next prime does not divide.
    EXPECT_GE(sample_count(with_sample_count(project.experiments[0], 4099, accumulating()), accumulating()),
              4099u);
    const auto& plain = project.experiments[1];
    EXPECT_EQ(with_sample_count(plain, 64, accumulating()), plain);
}

KeptResult kept(const std::string& key, std::uint64_t samples, bool with_state = true) {
    KeptResult result;
    result.key = key;
    result.experiment = "fog-nave";
    result.state_key = "one-picture";
    result.samples = samples;
    result.files = {{"main", key + "/main.exr", hash_bytes(key)}};
    if (with_state) result.files.push_back({"state", key + "/state.exr", hash_bytes(key + "state")});
    return result;
}

class KeepTest : public ::testing::Test {
  protected:
    void put(const KeptResult& result, const std::set<std::string>& in_use = {}) {
        const ResultsGuard guard(folder.path());
        for (const auto& file : result.files)
            if (!fs::exists(at(file.path))) testing::write_text(at(file.path), result.key);
        keep(folder.path(), result, in_use, guard);
    }
    fs::path at(const std::string& path) const { return folder.path() / "results" / path; }
    ResultIndex index() const { return ResultIndex::load(folder.path()); }
    TemporaryFolder folder;
};

TEST_F(KeepTest, RemembersStateKeyAndSamples) {
    put(kept("k64", 64));
    EXPECT_EQ(*index().find("k64"), kept("k64", 64));
    EXPECT_EQ(index().find_state("one-picture")->key, "k64");
    EXPECT_EQ(index().find_state("another"), nullptr);
    EXPECT_EQ(index().find_state(""), nullptr);
}

TEST_F(KeepTest, MoreSamplesTakeTheStateAndLeaveThePicturesThatAreInUse) {
    put(kept("k16", 16));
    put(kept("k64", 64), {"k16"});
    EXPECT_TRUE(fs::exists(at("k16/main.exr")));
    EXPECT_FALSE(fs::exists(at("k16/state.exr")));
    EXPECT_EQ(file_of(*index().find("k16"), state_role), nullptr);
    EXPECT_EQ(index().find_state("one-picture")->key, "k64");
    put(kept("k256", 256), {"k64"});
    EXPECT_EQ(index().find("k16"), nullptr);
    EXPECT_FALSE(fs::exists(at("k16/main.exr")));
    EXPECT_TRUE(fs::exists(at("k64/main.exr")));
    EXPECT_EQ(index().find_state("one-picture")->key, "k256");
}

TEST_F(KeepTest, FewerSamplesAndOtherPicturesTakeNothing) {
    put(kept("k64", 64));
    put(kept("k16", 16, false));
    auto other = kept("other", 4096);
    other.state_key = "another-picture";
    put(other);
    auto plain = kept("plain", 0, false);
    plain.state_key.clear();
    put(plain);
    EXPECT_EQ(index().entries().size(), 4u);
    EXPECT_TRUE(fs::exists(at("k64/state.exr")));
}

/// A result that asks for fewer samples than are kept has the files of that which has them.
TEST_F(KeepTest, SharedFilesStayAsLongAsOneNamesThem) {
    put(kept("k64", 64));
    auto served = kept("k16", 64, false);
    served.files[0].path = "k64/main.exr";
    put(served);
    put(kept("k256", 256), {"k16"});
    EXPECT_EQ(index().find("k64"), nullptr);
    EXPECT_FALSE(fs::exists(at("k64/state.exr")));
    EXPECT_TRUE(fs::exists(at("k64/main.exr")));
    EXPECT_TRUE(fs::exists(at("k256/state.exr")));
}

TEST_F(KeepTest, LastResultsAndWhatTheSavedDocumentAsksForAreInUse) {
    const auto project = sample_project();
    put(kept("k16", 16, false));
    const auto in_use = [&](const std::string& kept = "another") {
        return keys_in_use(index(), kept, folder.path(), accumulating());
    };
    EXPECT_EQ(in_use(), std::set<std::string>{"k16"});
    EXPECT_EQ(in_use("fog-nave"), std::set<std::string>()) << "its next one takes the place of k16";
    save_project(project, folder.path(), "");
    const auto now = load_project(folder.path(), accumulating()).project;
    std::set<std::string> keys{"k16"};
    for (const auto& each : now.experiments) keys.insert(result_key(now, each, accumulating()));
    EXPECT_EQ(in_use(), keys);
    testing::write_text(folder.path() / project_file_name, "damaged");
    EXPECT_EQ(in_use(), std::set<std::string>{"k16"});
}

/// Two processes compute one reference; one has all of it when the other is interrupted.
TEST_F(KeepTest, FewerSamplesBecomeTheLastOnlyWhereTheyAreAskedFor) {
    put(kept("k64", 64));
    put(kept("k16", 16, false));
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "k64"}}));
    put(kept("k16", 16, false), {"k16"});
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "k16"}}));
    auto other = kept("other", 4);
    other.state_key = "another-picture";
    put(other);
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "other"}}));
}

TEST_F(KeepTest, WhatProcessesThatEndedLeftHalfWrittenGoes) {
    const auto ended = fork();
    if (ended == 0) _exit(0);
    ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
    const auto left = "k16/state.exr." + std::to_string(ended) + "-3.tmp";
    const auto own = "k16/state.exr." + std::to_string(::getpid()) + "-3.tmp";
    for (const auto& name : {left, own}) testing::write_text(at(name), "half");
    put(kept("k64", 64));
    EXPECT_FALSE(fs::exists(at(left)));
    EXPECT_TRUE(fs::exists(at(own))) << "somebody still writes it";
}

/// In a shared folder the guard is another person's.
TEST_F(KeepTest, AGuardThatOnlyOthersMayWriteGuards) {
    const auto before = ::umask(002);
    { const ResultsGuard guard(folder.path()); }
    ::umask(before);
    const auto guard_file = at(results_guard_name);
    EXPECT_EQ(fs::status(guard_file).permissions(), fs::perms(0664)) << "as all files";
    fs::permissions(guard_file, fs::perms(0444));
    fs::permissions(folder.path(), fs::perms(0755));
    fs::permissions(guard_file.parent_path(), fs::perms(0777));
    const auto user = ::geteuid();
    const auto nobody = user == 0 ? 65534 : user;  // who may write everything tells nothing
    ASSERT_EQ(::seteuid(nobody), 0);
    EXPECT_NO_THROW(EXPECT_TRUE(ResultsGuard(folder.path()).is_guarding()));
    ASSERT_EQ(::seteuid(user), 0);
    fs::permissions(guard_file.parent_path(), fs::perms(0555));
    ASSERT_EQ(::seteuid(nobody), 0);
    EXPECT_THROW(ResultsGuard(folder.path()), Error) << "nothing can be kept there";
    ASSERT_EQ(::seteuid(user), 0);
    fs::permissions(guard_file.parent_path(), fs::perms(0755));
}

TEST_F(KeepTest, EachExperimentHasItsLastResultAlsoWhereTwoHaveTheSamePicture) {
    put(kept("k1", 1));
    put(kept("k2", 1));
    auto shared = kept("k1", 1);
    shared.experiment = "twin";
    put(shared);
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "k2"}, {"twin", "k1"}}));
    put(kept("k1", 1));
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "k1"}, {"twin", "k1"}}));
    // What is gone is nobody's; the one before is the last again.
    auto edited = index();
    edited.erase("k1");
    EXPECT_EQ(edited.last_kept(), (LastKept{{"fog-nave", "k2"}}));
}

/// As version 0.1 wrote it.
TEST_F(KeepTest, AnIndexThatDoesNotSayWhatWasLastIsReadByDate) {
    ResultIndex old;
    for (const auto& [key, day] : {std::pair{"k1", 2}, std::pair{"k2", 3}, std::pair{"k3", 1}}) {
        auto result = kept(key, 1);
        result.provenance.date = "2024-05-0" + std::to_string(day) + "T12:00:00Z";
        old.put(result);
    }
    old.save(folder.path());
    EXPECT_EQ(index().last_kept(), (LastKept{{"fog-nave", "k2"}}));
}

TEST_F(KeepTest, AFolderThatCannotBeWrittenIsNamed) {
    testing::write_text(folder.path() / "results", "in the way");
    try {
        const ResultsGuard guard(folder.path());
        FAIL() << "nothing is guarded";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find((folder.path() / "results").string()), std::string::npos)
            << error.what();
    }
}

/// Between reading a document and pruning others keep results.
TEST_F(KeepTest, PruneKeepsWhatWasKeptSinceTheDocumentWasRead) {
    const auto project = sample_project();
    put(kept("k64", 64));
    EXPECT_TRUE(prune_results(project, accumulating(), folder.path()).keys.empty());
    EXPECT_NE(index().find("k64"), nullptr);
}

TEST_F(KeepTest, PruneKeepsTheGuardAndDropsStatesWithTheirResults) {
    auto result = kept("k64", 64);
    result.experiment = "gone";
    put(result);
    EXPECT_EQ(prune_results(sample_project(), accumulating(), folder.path()).files,
              (std::vector<std::string>{"k64/main.exr", "k64/state.exr"}));
    EXPECT_TRUE(fs::exists(at(results_guard_name)));
}

/// Each reads the index, adds to it and writes it. Without the guard this fails at once: one takes away the
/// temporary file that another is about to rename.
TEST_F(KeepTest, WritersAtOnceLoseNoEntries) {
    constexpr int writers = 4, results = 12;
    std::vector<std::thread> threads;
    for (int w = 0; w < writers; ++w)
        threads.emplace_back([&, w] {
            for (int i = 0; i < results; ++i) {
                auto result = kept("w" + std::to_string(w) + "-" + std::to_string(i), 1, false);
                result.state_key.clear();
                result.experiment = result.key;
                put(result);
            }
        });
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(index().entries().size(), static_cast<std::size_t>(writers * results));
    EXPECT_EQ(index().last_kept().size(), static_cast<std::size_t>(writers * results));
    EXPECT_TRUE(check_results(index(), folder.path()).empty());
}

TEST(Changes, BetweenTwoResultsNameInputsAndProvenance) {
    auto a = kept("aaaaaa1", 16), b = kept("aaaaaa2", 64);
    a.inputs = {{"frames", 1}, {"seed", 7}};
    b.inputs = {{"frames", 4}, {"seed", 7}};
    a.provenance = {"0.1", "driver", "egl", "2024-05-01T12:00:00Z", Json::object()};
    b.provenance = {"0.2", "driver", "osmesa", "2024-05-01T12:00:00Z", Json::object()};
    a.provenance.processor = "gl";
    b.provenance.processor = "host";
    b.provenance.extra["resumed_from"] = Json::array(
        {{{"build", "0.1"}, {"driver", "driver"}, {"backend", "egl"}, {"date", ""}, {"samples", 16}}});
    const auto found = changes(version_of(a), version_of(b));
    EXPECT_EQ(found.inputs, std::vector<std::string>{"frames: 1 → 4"});
    EXPECT_EQ(found.provenance,
              (std::vector<std::string>{"build: 0.1 → 0.2", "backend: egl → osmesa", "processor: gl → host",
                                        "samples: 16 → 64",
                                        "resumed from: none → 16 samples by 0.1 on driver (egl)"}));
    EXPECT_TRUE(changes(version_of(a), version_of(a)).empty());
}

TEST(Changes, AreAskedForByExperimentKeyOrNow) {
    auto project = sample_project();
    ResultIndex index;
    index.put(kept("abcdef1", 16));
    index.put(kept("abcdef2", 64));
    project.experiments[0].last_kept_key = "abcdef2";
    const auto find = [&](const std::string& text) {
        return find_version(text, project, index, accumulating());
    };
    EXPECT_EQ(find("fog-nave").key, "abcdef2");
    EXPECT_EQ(find("abcdef1").samples, 16u);
    EXPECT_EQ(find("now:fog-nave").key, result_key(project, project.experiments[0], accumulating()));
    for (const char* text : {"abcdef", "abcde", "nothing", "now:nothing", "plain-nave", ""})
        EXPECT_THROW(find(text), UsageError) << text;
}

}  // namespace
}  // namespace ir::projects
