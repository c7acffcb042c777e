// All that a project writes, on disks with every amount of room.
#include <gtest/gtest.h>

#include "projects/autosave.h"
#include "projects/hash.h"
#include "projects/open_project.h"
#include "projects/pack.h"
#include "projects/results.h"
#include "projects/store.h"
#include "tests/unit/projects/numbered.h"
#include "tests/unit/projects/sample.h"
#include "tests/unit/scarce_disk.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::edit_to;
using testing::home;
using testing::numbered;
using testing::registry;
using testing::saved_hash;
using testing::state_of;
using testing::TemporaryFolder;

constexpr std::size_t step = 512;  // bytes

void save_the_first(const fs::path& disk) {
    save_project(numbered(1), home(disk), "");
}

std::string expect_state(const Project& project, int state) {
    return state_of(project) == state ? "" : "holds state " + std::to_string(state_of(project));
}

struct Deed {
    const char* name;
    Ordeal ordeal;
};

void PrintTo(const Deed& deed, std::ostream* out) {
    *out << deed.name;
}

Deed save() {
    return {"Save",
            {save_the_first,
             [](const fs::path& disk) { save_project(numbered(2), home(disk), saved_hash(home(disk))); },
             [](const fs::path& disk, bool done) {
                 return expect_state(load_project(home(disk), registry()).project, done ? 2 : 1);
             }}};
}

/// Its lock needs room as well.
Deed open_and_save() {
    return {"OpenAndSave",
            {save_the_first,
             [](const fs::path& disk) {
                 OpenProject open(home(disk), registry());
                 if (open.is_read_only()) throw Error(open.read_only_reason());
                 edit_to(open, 2);
                 open.save();
             },
             [](const fs::path& disk, bool done) {
                 return expect_state(load_project(home(disk), registry()).project, done ? 2 : 1);
             }}};
}

Deed autosave() {
    return {"Autosave",
            {[](const fs::path& disk) {
                 save_the_first(disk);
                 write_autosave(numbered(2), home(disk), saved_hash(home(disk)));
             },
             [](const fs::path& disk) {
                 AutosaveThread thread;
                 thread.request(numbered(3), home(disk), saved_hash(home(disk)));
                 thread.flush();
                 if (const auto error = thread.take_error(); !error.empty()) throw Error(error);
             },
             [](const fs::path& disk, bool done) -> std::string {
                 const auto found = find_recovery(home(disk), registry());
                 return found ? expect_state(found->project, done ? 3 : 2) : "there is no recovery";
             }}};
}

Deed session() {
    return {"Session",
            {[](const fs::path& disk) {
                 save_session(disk, Json{{"old", true}});
             },
             [](const fs::path& disk) {
                 save_session(disk, Json{{"new", std::string(5000, 'n')}});
             },
             [](const fs::path& disk, bool done) -> std::string {
                 return load_session(disk).contains(done ? "new" : "old") ? "" : "another session";
             }}};
}

/// A result's files, then the index that names them.
Deed index() {
    static const auto keep = [](const fs::path& disk, const std::string& key) {
        const std::string bytes(3000, key.front());
        const auto file = home(disk) / "results" / key / "main.exr";
        real_file_system().create_directories(file.parent_path());
        write_atomically(real_file_system(), file, bytes);
        KeptResult result;
        result.key = key;
        result.files = {{"main", key + "/main.exr", hash_bytes(bytes), {}}};
        auto results = ResultIndex::load(home(disk));
        results.put(result);
        results.save(home(disk));
    };
    return {"KeepAResult",
            {[](const fs::path& disk) {
                 save_the_first(disk);
                 keep(disk, "old");
             },
             [](const fs::path& disk) { keep(disk, "new"); },
             [](const fs::path& disk, bool done) -> std::string {
                 const auto results = ResultIndex::load(home(disk));
                 if (!results.find("old") || (results.find("new") != nullptr) != done) return "another index";
                 return check_results(results, home(disk)).empty() ? "" : "a listed result is damaged";
             }}};
}

Deed pack() {
    return {"Pack",
            {[](const fs::path& disk) {
                 save_the_first(disk);
                 write_bytes(disk / "a.tar", "the archive before");
             },
             [](const fs::path& disk) { pack_project(home(disk), disk / "a.tar", registry()); },
             [](const fs::path& disk, bool done) -> std::string {
                 if (!done) return read_bytes(disk / "a.tar") == "the archive before" ? "" : "it is gone";
                 fs::create_directories(disk / "there");
                 const auto unpacked = unpack_project(disk / "a.tar", disk / "there");
                 return expect_state(load_project(unpacked, registry()).project, 1);
             }}};
}

Deed unpack() {
    return {"Unpack",
            {[](const fs::path& disk) {
                 save_the_first(disk);
                 pack_project(home(disk), disk / "a.tar", registry());
                 fs::create_directories(disk / "there");
             },
             [](const fs::path& disk) { unpack_project(disk / "a.tar", disk / "there"); },
             [](const fs::path& disk, bool done) -> std::string {
                 if (!done) return fs::is_empty(disk / "there") ? "" : "a part of it was left";
                 return expect_state(load_project(home(disk / "there"), registry()).project, 1);
             }}};
}

Deed save_as() {
    return {"SaveAs",
            {save_the_first,
             [](const fs::path& disk) {
                 OpenProject open(home(disk), registry());
                 if (open.is_read_only()) throw Error(open.read_only_reason());
                 edit_to(open, 2);
                 open.save_as(disk / "b.interreflect");
             },
             [](const fs::path& disk, bool done) -> std::string {
                 if (state_of(load_project(home(disk), registry()).project) != 1) return "the first is lost";
                 if (!done) return fs::exists(disk / "b.interreflect") ? "a part of it was left" : "";
                 return expect_state(load_project(disk / "b.interreflect", registry()).project, 2);
             }}};
}

class FullDisk : public ::testing::TestWithParam<Deed> {
  protected:
    TemporaryFolder folder{TemporaryFolder::Place::memory};
};

TEST_P(FullDisk, WithEveryLimitOnTheSizeOfFiles) {
    EXPECT_EQ(with_small_files(folder.path(), GetParam().ordeal, step), "ok");
}

TEST_P(FullDisk, WithEveryNumberOfFreePages) {
    const auto answer = with_few_pages(folder.path(), GetParam().ordeal);
    if (answer == "not allowed")
        GTEST_SKIP() << "needs the right to mount; its twin limits the size of files";
    EXPECT_EQ(answer, "ok");
}

INSTANTIATE_TEST_SUITE_P(Projects, FullDisk,
                         ::testing::Values(save(), open_and_save(), autosave(), session(), index(), pack(),
                                           unpack(), save_as()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace ir::projects
