#pragma once

#include <filesystem>
#include <string>

#include "app/cli/command.h"
#include "app/cli/progress_line.h"
#include "app/engine/run_frames.h"
#include "projects/document.h"

namespace ir::cli {

/// "--checkpoint SECONDS"
void add_checkpoint_flag(CLI::App& command, double& seconds);

struct KeptRun {
    FrameReport report;
    std::string key;                 ///< of the kept result
    std::uint64_t resumed_from = 0;  ///< samples
};

/// Once an interrupted run is put away.
void tell_kept(const engine::Execution& execution, const std::string& id);

/// Goes on from what the project keeps of the experiment, runs all its frames and keeps the result. Every
/// `checkpoint` seconds of rendering, and when it is interrupted, what adds up is kept as a result with as
/// many samples as there are; the latter is said before Cancelled goes on. Clears the line once nothing more
/// is told. Throws as engine::run_frames and engine::keep_result.
KeptRun run_and_keep(engine::Execution& execution, graph::FrameOptions options,
                     const projects::Project& project, const projects::Experiment& experiment,
                     const std::filesystem::path& folder, double checkpoint, const ProgressLine& line);

}  // namespace ir::cli
