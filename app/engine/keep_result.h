#pragma once

#include <filesystem>
#include <string>

#include "app/engine/execution.h"
#include "projects/document.h"

namespace ir::engine {

/// Stores an execution's main result, its variance where it is there, statistics, and the history of methods
/// that accumulate in the project's results/, with provenance, as the experiment's last, and returns its key:
/// that of the scene files as they are now, which it reads. Several processes may do so at the same time.
/// A picture that has fewer samples than the experiment asks for gets the key of what it is. One that was
/// restored from a kept result and not extended is not stored again: the result then shares its files. Every
/// file appears whole or not at all. Throws Error.
std::string keep_result(const projects::Project& project, const projects::Experiment& experiment,
                        const std::filesystem::path& folder, const Execution& execution,
                        const FrameReport& report);

/// Makes the execution go on from the largest state that the project keeps of the experiment. Returns one
/// line for each that could not be used; where there is none, nothing happens.
std::vector<std::string> resume_kept(Execution& execution, const projects::Project& project,
                                     const projects::Experiment& experiment,
                                     const std::filesystem::path& folder);

}  // namespace ir::engine
