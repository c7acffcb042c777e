#include "projects/scene_hasher.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "projects/check.h"
#include "projects/hash.h"
#include "projects/hash_cache.h"
#include "projects/open_project.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::mentions;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;
using testing::unhashed_sample;

/// Times of files are kept in steps of some milliseconds.
void let_time_pass() {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
}

TEST(HashCache, ReadsAFileOnceUntilItChanges) {
    TemporaryFolder folder;
    const auto file = folder.path() / "a.bin";
    testing::write_text(file, "one");
    let_time_pass();
    HashCache cache(std::chrono::milliseconds(0));
    EXPECT_EQ(cache.hash(file), hash_bytes("one"));
    EXPECT_EQ(cache.hash(file), hash_bytes("one"));
    EXPECT_EQ(cache.reads(), 1u);
    testing::write_text(file, "two");  // of the same length
    let_time_pass();
    EXPECT_EQ(cache.hash(file), hash_bytes("two"));
    EXPECT_EQ(cache.reads(), 2u);

    // Replaced by another file that claims the same time and length.
    const auto other = folder.path() / "b.bin";
    testing::write_text(other, "six");
    fs::last_write_time(other, fs::last_write_time(file));
    fs::rename(other, file);
    EXPECT_EQ(cache.hash(file), hash_bytes("six"));
    fs::remove(file);
    EXPECT_THROW(cache.hash(file), InputError);
}

TEST(HashCache, DoesNotTrustAFileThatChangedJustNow) {
    TemporaryFolder folder;
    const auto file = folder.path() / "a.bin";
    testing::write_text(file, "one");
    HashCache cache(std::chrono::hours(1));
    for (int i = 1; i <= 3; ++i) {
        EXPECT_EQ(cache.hash(file), hash_bytes("one"));
        EXPECT_EQ(cache.reads(), static_cast<std::uint64_t>(i));
    }
}

TEST(HashFile, StopsBetweenBlocks) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / "a.bin", std::string(3 << 20, 'x'));
    CancelToken cancel;
    cancel.cancel();
    EXPECT_THROW(hash_file(folder.path() / "a.bin", &cancel), Cancelled);
    EXPECT_EQ(hash_file(folder.path() / "a.bin"), hash_bytes(std::string(3 << 20, 'x')));
}

TEST(SceneHasher, FindsHashesAndMissingFilesOnItsThread) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / "a.glb", "a");
    std::atomic<int> calls{0};
    SceneHasher hasher([&] { ++calls; });
    hasher.request({"a.glb", "gone.glb", "builtin:room@1"}, folder.path());
    hasher.wait();
    EXPECT_FALSE(hasher.is_busy());
    EXPECT_EQ(calls, 3);
    ContentHashes hashes;
    EXPECT_TRUE(hasher.take(hashes));
    EXPECT_EQ(hashes, (ContentHashes{{"a.glb", hash_bytes("a")},
                                     {"gone.glb", ""},
                                     {"builtin:room@1", scene_hash("builtin:room@1", "")}}));
    EXPECT_FALSE(hasher.take(hashes));

    hasher.request({"a.glb"}, folder.path());
    hasher.wait();
    EXPECT_FALSE(hasher.take(hashes)) << "the same hash is no news";
    testing::write_text(folder.path() / "a.glb", "b");
    hasher.request({"a.glb"}, folder.path());
    hasher.wait();
    EXPECT_TRUE(hasher.take(hashes));
    EXPECT_EQ(hashes.at("a.glb"), hash_bytes("b"));
}

TEST(SceneHasher, SaysWhatItFoundBeforeSomeoneListened) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / "a.bin", "one");
    SceneHasher hasher;
    hasher.request({"a.bin"}, folder.path());
    hasher.wait();
    int words = 0;
    hasher.set_on_news([&] { ++words; });
    EXPECT_EQ(words, 1);
    ContentHashes hashes;
    AnimationEnds ends;
    EXPECT_TRUE(hasher.take(hashes));
    EXPECT_TRUE(hasher.take(ends));
    hasher.set_on_news([&] { ++words; });
    EXPECT_EQ(words, 1) << "it was taken";
}

TEST(SceneHasher, ANewerRequestReplacesTheOneBeingRead) {
    TemporaryFolder first, second;
    testing::write_text(first.path() / "a.glb", "");
    fs::resize_file(first.path() / "a.glb", 256u << 20);  // takes a while, but no disk
    testing::write_text(second.path() / "b.glb", "b");
    SceneHasher hasher;
    for (int round = 0; round < 5; ++round) {
        hasher.request({"a.glb", "builtin:a@1", "builtin:b@1"}, first.path());
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
        hasher.request({"b.glb"}, second.path());
        hasher.wait();
        ContentHashes hashes;
        hasher.take(hashes);
        ASSERT_EQ(hashes, (ContentHashes{{"b.glb", hash_bytes("b")}}));
    }
}

TEST(SceneHasher, EndsWhileManyFilesWait) {
    TemporaryFolder folder;
    std::set<std::string> many;
    for (int i = 0; i < 64; ++i) {
        const auto& name = *many.insert(std::to_string(i) + ".glb").first;
        testing::write_text(folder.path() / name, "");
        fs::resize_file(folder.path() / name, 64u << 20);  // takes a while, but no disk
    }
    const auto reads = [before = shared_hash_cache().reads()] {
        return shared_hash_cache().reads() - before;
    };
    {
        SceneHasher hasher;
        hasher.request(many, folder.path());
        while (reads() == 0) std::this_thread::yield();
    }
    EXPECT_LT(reads(), many.size()) << "of two for each file";
}

/// A project of scenes whose hashes are recorded.
class HashedProject : public ::testing::Test {
  protected:
    HashedProject() {
        testing::write_sample_files(folder);
        save_project(with_missing_hashes(unhashed_sample(), folder), folder, "");
    }
    TemporaryFolder temporary;
    fs::path folder = temporary.path() / "a.interreflect";
};

TEST_F(HashedProject, KnownHashesGiveTheSameStatesAsReading) {
    auto project = load_project(folder, registry()).project;
    testing::write_text(folder / "scenes/organ.glb", "another organ");
    fs::remove(folder / "sky.exr");
    const auto& parts = project.scenes[0].parts;
    const ContentHashes nothing;
    EXPECT_EQ(status(parts[0], folder, &nothing).state, FileState::unread);
    EXPECT_EQ(status(project.lights[1].environment, folder, &nothing).state, FileState::missing);
    EXPECT_EQ(status(project.scenes[1].parts[0], folder, &nothing).state, FileState::ok);  // built in

    SceneHasher hasher;
    hasher.request(sources_of(project), folder);
    hasher.wait();
    ContentHashes known;
    hasher.take(known);
    for (const auto& scene : project.scenes)
        for (const auto& part : scene.parts) {
            EXPECT_EQ(status(part, folder, &known).state, status(part, folder).state) << part.source;
            EXPECT_EQ(status(part, folder, &known).hash_now, status(part, folder).hash_now) << part.source;
        }
    EXPECT_EQ(status(parts[1], folder, &known).state, FileState::changed);
    EXPECT_EQ(status(project.lights[1].environment, folder, &known).state, FileState::missing);
    EXPECT_EQ(status(project.images[0], folder, &known).state, FileState::ok);
    EXPECT_EQ(with_current_hashes(project.scenes[0], folder, &known),
              with_current_hashes(project.scenes[0], folder));

    // It came back after the hasher looked: what it holds is not known.
    testing::write_text(folder / "sky.exr", "sky");
    EXPECT_EQ(status(project.lights[1].environment, folder, &known).state, FileState::unread);
}

TEST_F(HashedProject, OpeningDoesNotReadScenesAndTellsLaterWhatChanged) {
    testing::write_text(folder / "scenes/organ.glb", "another organ");
    fs::remove(folder / "photo.exr");
    OpenProject open(folder, registry());
    EXPECT_TRUE(mentions(open.messages(), "'photo.exr' is missing"));
    EXPECT_FALSE(mentions(open.messages(), "is not the file"));
    open.wait_for_files();
    EXPECT_TRUE(mentions(open.messages(), "'scenes/organ.glb' is not the file that was recorded"));
    EXPECT_FALSE(open.poll_files());

    const auto accepted = with_current_hashes(open.project().scenes[0], folder, &open.contents());
    open.edit(edits::change(open.project(), accepted));
    open.check_again();
    EXPECT_FALSE(mentions(open.messages(), "is not the file"));
    open.undo();
    open.check_again();
    EXPECT_TRUE(mentions(open.messages(), "is not the file"));

    testing::write_text(folder / "photo.exr", "content of photo.exr");
    open.look_at_files();
    open.wait_for_files();
    EXPECT_FALSE(mentions(open.messages(), "missing"));
}

TEST_F(HashedProject, AnEditThatNamesANewFileIsLookedAt) {
    testing::write_text(folder / "moved.glb", "content of scenes/church.glb");
    OpenProject open(folder, registry());
    open.wait_for_files();
    const auto found = located(open.project().scenes[0], 0, folder / "moved.glb", folder);
    open.edit(edits::change(open.project(), found));
    EXPECT_EQ(status(found.parts[0], folder, &open.contents()).state, FileState::unread);
    open.wait_for_files();
    EXPECT_EQ(status(found.parts[0], folder, &open.contents()).state, FileState::ok);
}

TEST(UnsavedProject, LooksAtItsFilesToo) {
    OpenProject open(registry());
    open.edit(edits::add(open.project(), Scene{"a", "A", {{"no/such/file.glb", "", {}}}}));
    open.wait_for_files();
    ASSERT_EQ(open.messages().size(), 1u);
    EXPECT_NE(open.messages()[0].text.find("is missing"), std::string::npos);
}

TEST_F(HashedProject, ResultsAreStaleWhenInputsOrFilesChanged) {
    OpenProject open(folder, registry());
    open.wait_for_files();
    EXPECT_TRUE(open.stale_experiments().empty());
    LastKept kept;
    for (const auto& e : open.project().experiments) kept[e.id] = result_key(open.project(), e, registry());
    open.set_last_kept(kept);
    EXPECT_TRUE(open.stale_experiments().empty());

    open.edit(edits::set_seed(open.project(), "plain-nave", 77));
    EXPECT_EQ(open.stale_experiments(), std::vector<std::string>{"plain-nave"});
    EXPECT_TRUE(is_stale(open.project(), open.project().experiments[1], registry()));
    EXPECT_FALSE(is_stale(open.project(), open.project().experiments[0], registry()));
    open.undo();
    EXPECT_TRUE(open.stale_experiments().empty());

    // The scene's file changes on disk: its kept result is no longer what would be rendered now.
    testing::write_text(folder / "scenes/organ.glb", "another organ");
    open.look_at_files();
    open.wait_for_files();
    EXPECT_EQ(open.stale_experiments(), std::vector<std::string>{"fog-nave"});
    EXPECT_FALSE(is_stale(open.project(), open.project().experiments[0], registry()));
    EXPECT_TRUE(is_stale(open.project(), open.project().experiments[0], registry(), open.contents()));
    EXPECT_TRUE(mentions(open.messages(), "stale"));
    open.edit(edits::change(open.project(),
                            with_current_hashes(open.project().scenes[0], folder, &open.contents())));
    EXPECT_EQ(open.stale_experiments(), std::vector<std::string>{"fog-nave"});
}

}  // namespace
}  // namespace ir::projects
