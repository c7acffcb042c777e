#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "projects/document.h"

namespace ir::projects {

enum class FileState { ok, missing, changed, unhashed };
std::string to_string(FileState state);

struct FileStatus {
    FileState state = FileState::ok;
    std::string source;              ///< as the document says
    std::filesystem::path resolved;  ///< absolute; empty for built-in scenes
    std::string hash_now;            ///< empty when missing
};

bool is_builtin(const std::string& source);
/// Absolute path of a source that is a file. Relative ones start at the project folder.
std::filesystem::path resolve(const std::string& source, const std::filesystem::path& project_folder);
/// `file` as the document should hold it: relative to the project folder, '/' as separator; absolute only
/// where no relative path exists.
std::string relative_source(const std::filesystem::path& file, const std::filesystem::path& project_folder);
/// What the loader takes: the built-in name itself or the resolved path.
std::string loadable_source(const std::string& source, const std::filesystem::path& project_folder);

/// Content hash of a source: built-in scenes by name, version and options; files by their bytes and, for
/// glTF, those of the buffers and images they refer to. Throws InputError when a file cannot be read.
std::string scene_hash(const std::string& source, const std::filesystem::path& project_folder);
/// A glTF file and the files that it refers to, the file itself first.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& file);

FileStatus status(const ScenePart& part, const std::filesystem::path& project_folder);
FileStatus status(const Environment& environment, const std::filesystem::path& project_folder);
FileStatus status(const ForeignImage& image, const std::filesystem::path& project_folder);

/// Locate…: the scene with `part` pointing to `file`; with the recorded hash kept, so that another file than
/// the old one shows as changed. Apply with edits::change_scene.
Scene located(const Scene& scene, std::size_t part, const std::filesystem::path& file,
              const std::filesystem::path& project_folder);
/// The scene with all hashes as the files are now: "accept". Missing files keep the recorded hash.
Scene with_current_hashes(const Scene& scene, const std::filesystem::path& project_folder);
/// The document with hashes recorded for all sources that have none yet and whose files exist: to be called
/// after adding files and before keeping results.
Project with_missing_hashes(const Project& project, const std::filesystem::path& project_folder);

}  // namespace ir::projects
