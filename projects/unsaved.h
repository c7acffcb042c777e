#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "projects/document.h"
#include "projects/lock.h"
#include "renderers/core/file_system.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// A project that was never saved has no folder to be autosaved in. It gets one of its own, which holds
/// nothing but the autosave and the lock of the process that edits it.
class UnsavedHome {
  public:
    UnsavedHome() = default;  ///< none
    /// Makes NAME-PID-TIME.interreflect inside `place`, which is created where it is missing. Throws Error.
    static UnsavedHome make(const std::filesystem::path& place, const std::string& name, FileSystem& files);
    /// That of a process that ended. Throws Error when one lives, or when it is no such folder.
    static UnsavedHome take_over(const std::filesystem::path& folder, FileSystem& files);

    const std::filesystem::path& folder() const { return folder_; }  ///< empty: none
    bool is_ours(FileSystem& files) const { return lock_.is_still_ours(files); }
    /// Removes the autosave and the folder. Throws Error; nothing where there is none.
    void remove(FileSystem& files);

  private:
    std::filesystem::path folder_;
    Lock lock_;
};

/// Whether the folder holds a project that was never saved, and nothing else.
bool is_unsaved(const std::filesystem::path& folder, FileSystem& files = real_file_system());

struct UnsavedProject {
    std::filesystem::path folder;  ///< for OpenProject::recover_unsaved
    std::string name;
    std::int64_t modified = 0;  ///< as FileSystem::modified
};
/// What processes that no longer live left in `place`, newest first. Reads only; damaged ones are left out.
std::vector<UnsavedProject> find_unsaved(const std::filesystem::path& place, const Registry& registry,
                                         FileSystem& files = real_file_system());

/// The document with absolute paths, so that it means the same wherever it is read.
Project with_absolute_sources(const Project& project, const std::filesystem::path& project_folder);

}  // namespace ir::projects
