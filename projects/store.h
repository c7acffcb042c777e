#pragma once

#include <filesystem>
#include <string>

#include "projects/document_json.h"
#include "projects/json.h"
#include "projects/results.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"

namespace ir::projects {

inline constexpr const char* project_file_name = "project.json";
inline constexpr const char* previous_file_name = "project.json.previous";
inline constexpr const char* autosave_file_name = "project.json.autosave";
inline constexpr const char* folder_suffix = ".interreflect";

/// The folder of a project, given the folder or the project.json inside it. Throws InputError for anything
/// else.
std::filesystem::path project_folder(const std::filesystem::path& given);
/// Where a new project called so would live: adds the suffix .interreflect where it is missing.
std::filesystem::path folder_with_suffix(const std::filesystem::path& given);

/// project.json was written by somebody else since it was read; overwriting would lose that.
class ChangedOnDisk : public Error {
  public:
    using Error::Error;
};

struct LoadedProject : ReadProject {
    std::filesystem::path folder;
    std::string file_hash;  ///< of the bytes read; save() compares
    LastKept last_kept;     ///< which the document's experiments have been told
};

/// Reads without locking and without writing anything: what the command line uses to render. Throws
/// InputError; when project.json is damaged and a previous version exists, the line says so.
LoadedProject load_project(const std::filesystem::path& given, const Registry& registry,
                           FileSystem& files = real_file_system());

/// Saves into `folder` (created where missing): the version before is kept as project.json.previous.
/// `expected_hash` is LoadedProject::file_hash or what the last save returned; when the file on disk has
/// another content, somebody else wrote it and the save is refused with ChangedOnDisk (pass an empty string
/// to overwrite regardless). Returns the hash of the bytes written. On failure nothing is lost.
std::string save_project(const Project& project, const std::filesystem::path& folder,
                         const std::string& expected_hash, FileSystem& files = real_file_system());

/// Rewrites a project with the newest schema, completed values, the registry's method versions and the hashes
/// of files that had none. Returns what was changed. Takes the lock; throws Error when another process holds
/// it, and Cancelled.
std::vector<Message> upgrade_project(const std::filesystem::path& given, const Registry& registry,
                                     FileSystem& files = real_file_system(),
                                     const CancelToken* cancel = nullptr);

/// Whether the file is the project's: its document, what is written beside it, a kept result, or a file of a
/// scene, an environment or an image. What sweeps leave in results/ is not: others go on with it. Links are
/// followed; the file need not exist.
bool is_own_file(const LoadedProject& project, const std::filesystem::path& file);

/// session.json: layout, zoom, pins. Free JSON of the window; neither undone nor dirty. A missing or damaged
/// file is an empty object: nothing of value is in it.
Json load_session(const std::filesystem::path& folder, FileSystem& files = real_file_system());
void save_session(const std::filesystem::path& folder, const Json& session,
                  FileSystem& files = real_file_system());

}  // namespace ir::projects
