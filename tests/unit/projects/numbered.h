#pragma once

#include <filesystem>
#include <set>

#include "projects/open_project.h"

/// Documents whose states are numbered in their notes, so that tests can tell which one survived.
namespace ir::projects::testing {

Project numbered(int state);
int state_of(const Project& project);
void edit_to(OpenProject& open, int state);

/// The project in a test's folder.
inline std::filesystem::path home(const std::filesystem::path& folder) {
    return folder / "a.interreflect";
}

/// The hash of the project.json in a folder.
std::string saved_hash(const std::filesystem::path& folder);

/// The lock that a killed process of this host leaves behind.
void leave_dead_lock(const std::filesystem::path& folder);
/// A lock of a process on another host.
void leave_foreign_lock(const std::filesystem::path& folder);

/// What a later session finds in a folder.
struct Found {
    int saved = 0;
    std::set<int> recoverable;  ///< recoveries that are offered, one after the other
    bool holds(int state) const { return saved == state || recoverable.count(state) != 0; }
    int newest() const { return recoverable.empty() ? saved : std::max(saved, *recoverable.rbegin()); }
};

/// Opens for writing, or fails the test. Leaves all recoveries on the disk.
Found open_again(const std::filesystem::path& folder);

}  // namespace ir::projects::testing
