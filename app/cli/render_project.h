#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/inspection.h"
#include "app/cli/progress_line.h"
#include "app/engine/run_frames.h"
#include "projects/document.h"
#include "renderers/core/shard.h"

namespace ir::cli {

struct ProjectRender {
    MachineFlags machine;
    std::string project, out;
    std::vector<std::string> experiments, dumps;
    InspectionFlags inspection;
    bool keep = false, show_progress = true;
    std::string json = {};  ///< file for all statistics, by experiment; "-": standard output
    double checkpoint = engine::Checkpoints::usual_seconds;  ///< of what is kept
    ExperimentFlags changes = {};                            ///< of every experiment
    Shard shard = {};                                        ///< of the experiments
};

/// Renders an experiment to OUT/ID.exr, OUT/ID.png and OUT/ID.json, and keeps the result in `folder` where
/// the job says so. Returns the statistics. Throws Error.
std::string render_one(const ProjectRender& job, engine::Machine& machine, const projects::Project& project,
                       const projects::Experiment& experiment, const std::filesystem::path& folder,
                       ProgressLine& line);

/// How much of the progress an experiment is.
double frames_of(const projects::Experiment& experiment);

/// An experiment that cannot run does not keep the others from it; the status then says that the file is at
/// fault. Renders the chosen experiments (all when none is named) to OUT/ID.exr and OUT/ID.json, and a
/// preview OUT/ID.png.
int render_project(const ProjectRender& job);

}  // namespace ir::cli
