#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "projects/document.h"
#include "renderers/core/report.h"

namespace ir::cli {

/// What the command line says of an experiment. What is not given stays as it is.
struct ExperimentFlags {
    std::vector<std::string> sets, shader_diffs;
    std::string camera, eye, target, up, size, seed, variant;
    std::optional<double> fov_y, time;
    std::optional<int> frames;
    bool operator==(const ExperimentFlags&) const = default;
};

void add_experiment_flags(CLI::App& command, ExperimentFlags& flags);

/// Changes an experiment of `project`; a camera of the command line becomes one of the project. Throws
/// UsageError.
void apply(const ExperimentFlags& flags, projects::Project& project, projects::Experiment& experiment);

/// Notes on each `--set` that does nothing under the other settings.
std::vector<Message> notes_of(const ExperimentFlags& flags, const std::string& method,
                              const Settings& settings);

}  // namespace ir::cli
