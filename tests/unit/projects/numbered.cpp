#include "tests/unit/projects/numbered.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "projects/hash.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects::testing {
namespace {

std::string this_host() {
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    return host;
}

void leave_lock(const std::filesystem::path& folder, const std::string& host) {
    // No living process of this host started with the machine's first tick.
    const Json lock = {{"host", host}, {"pid", ::getpid()}, {"started", 1}, {"since", "before"}};
    write_text(folder / ".lock", pretty_json(lock));
}

}  // namespace

Project numbered(int state) {
    auto project = sample_project();
    project.notes = "state " + std::to_string(state);
    return project;
}

int state_of(const Project& project) {
    return std::stoi(project.notes.substr(project.notes.rfind(' ')));
}

void edit_to(OpenProject& open, int state) {
    open.edit(edits::set_notes(open.project(), "state " + std::to_string(state)));
    open.end_gesture();
}

std::string saved_hash(const std::filesystem::path& folder) {
    return hash_bytes(read_text(folder / project_file_name));
}

void leave_dead_lock(const std::filesystem::path& folder) {
    leave_lock(folder, this_host());
}

void leave_foreign_lock(const std::filesystem::path& folder) {
    leave_lock(folder, "elsewhere");
}

Found open_again(const std::filesystem::path& folder) {
    OpenProject open(folder, registry());
    EXPECT_FALSE(open.is_read_only()) << open.read_only_reason();
    Found found;
    found.saved = state_of(open.project());
    while (open.recovery()) {
        found.recoverable.insert(state_of(open.recovery()->project));
        open.take_recovery();  // shows the next; without saving, all of them stay on the disk
    }
    return found;
}

}  // namespace ir::projects::testing
