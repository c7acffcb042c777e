#pragma once

#include <filesystem>
#include <string>

#include "app/engine/execution.h"
#include "projects/document.h"

namespace ir::engine {

/// Stores an execution's main result and statistics in the project's results/, with provenance, and returns
/// the key that the experiment should remember (projects::Experiment::last_kept_key): that of the scene files
/// as they are now, which it reads. Every file appears whole or not at all. Throws Error.
std::string keep_result(const projects::Project& project, const projects::Experiment& experiment,
                        const std::filesystem::path& folder, const Execution& execution,
                        const FrameReport& report);

}  // namespace ir::engine
