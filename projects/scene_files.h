#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/progress.h"

namespace ir::projects {

/// unhashed: nothing is recorded to compare with; unread: the file is there and its content not yet known.
enum class FileState { ok, missing, changed, unhashed, unread };
std::string to_string(FileState state);

/// What the files behind a document's sources contain now: hash by source as the document writes it. A source
/// that is not in it was not read yet; an empty hash is a file that cannot be read.
using ContentHashes = std::map<std::string, std::string>;

/// Until when files animate something, seconds, by their resolved paths: those of a project that is saved
/// elsewhere are known still.
using AnimationEnds = std::map<std::string, double>;

/// All sources of a document: parts of scenes, environment maps, foreign images.
std::set<std::string> sources_of(const Project& project);

struct FileStatus {
    FileState state = FileState::ok;
    std::string source;              ///< as the document says
    std::filesystem::path resolved;  ///< absolute; empty for built-in scenes
    std::string hash_now;            ///< empty when missing or unread
};

bool is_builtin(const std::string& source);
/// By its suffix, in small or capital letters.
bool is_gltf_name(const std::filesystem::path& file);
/// Whether somebody who gives this means a scene: builtin:NAME, or a glTF file by its name.
bool names_scene(const std::string& given);
/// Absolute path of a source that is a file. Relative ones start at the project folder, or at the current one
/// while the project was never saved and its folder is empty.
std::filesystem::path resolve(const std::string& source, const std::filesystem::path& project_folder);
/// `file` as the document should hold it: relative to the project folder, '/' as separator; absolute only
/// where no relative path exists.
std::string relative_source(const std::filesystem::path& file, const std::filesystem::path& project_folder);
/// What the loader takes: the built-in name itself or the resolved path.
std::string loadable_source(const std::string& source, const std::filesystem::path& project_folder);

/// Content hash of a source: built-in scenes by name, version and options; files by their bytes and, for
/// glTF, those of the buffers and images they refer to. Reads only what shared_hash_cache() does not know:
/// may take long for large scenes. Throws InputError when a file cannot be read, Cancelled once that is asked
/// for.
std::string scene_hash(const std::string& source, const std::filesystem::path& project_folder,
                       const CancelToken* cancel = nullptr);
/// A glTF file and the files that it refers to, the file itself first.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& file);
/// The files that a document names, and those that its glTF files name, which lie outside of its folder.
std::vector<std::filesystem::path> files_outside(const Project& project,
                                                 const std::filesystem::path& project_folder);

/// With `known` nothing is read: the state is that of the known hashes, and `unread` where there is none (a
/// missing file is seen at once). Without, files are read: not on the GUI thread.
FileStatus status(const ScenePart& part, const std::filesystem::path& project_folder,
                  const ContentHashes* known = nullptr);
FileStatus status(const Environment& environment, const std::filesystem::path& project_folder,
                  const ContentHashes* known = nullptr);
FileStatus status(const ForeignImage& image, const std::filesystem::path& project_folder,
                  const ContentHashes* known = nullptr);

/// Locate…: the scene with `part` pointing to `file`; with the recorded hash kept, so that another file than
/// the old one shows as changed. Apply with edits::change().
Scene located(const Scene& scene, std::size_t part, const std::filesystem::path& file,
              const std::filesystem::path& project_folder);
/// The scene with all hashes as the files are now: "accept". Missing (and unread) files keep the recorded
/// hash.
Scene with_current_hashes(const Scene& scene, const std::filesystem::path& project_folder,
                          const ContentHashes* known = nullptr);
/// Reads (or remembers) all sources of a document: for commands, not for the GUI thread. Throws Cancelled.
ContentHashes read_contents(const Project& project, const std::filesystem::path& project_folder,
                            const CancelToken* cancel = nullptr);
/// The document as if every known content had been accepted: whose result keys are those of the files as they
/// are now.
Project with_contents(const Project& project, const ContentHashes& known);
/// The document with hashes recorded for all sources that have none yet and whose files exist: to be called
/// after adding files and before keeping results. Throws Cancelled.
Project with_missing_hashes(const Project& project, const std::filesystem::path& project_folder,
                            const CancelToken* cancel = nullptr);
/// The same in place with what is known, without a look at any file. Returns what was recorded.
ContentHashes record_missing_hashes(Project& project, const ContentHashes& known);

}  // namespace ir::projects
