#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "projects/document_json.h"
#include "projects/scene_files.h"
#include "renderers/core/report.h"

namespace ir::projects {

/// Everything that a user should know about a project, most serious first: missing scenes and references to
/// nothing (errors), changed scenes, unknown keys and methods, an older schema, newer method versions, stale
/// results. With `known` no scene is read (see status() in scene_files.h).
std::vector<Message> check(const ReadProject& read, const std::filesystem::path& project_folder,
                           const Registry& registry, const ContentHashes* known = nullptr);

/// Why the experiment cannot run in this build, or empty: unknown method, missing scene, camera or lights,
/// changes of shaders that nobody has allowed.
std::string why_not_runnable(const Project& project, const Experiment& experiment, const Registry& registry,
                             const std::filesystem::path& project_folder);

/// The last of these alone.
std::string why_shaders_wait(const Project& project, const Experiment& experiment);

}  // namespace ir::projects
