#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/inspection.h"

namespace ir::cli {

struct ProjectRender {
    MachineFlags machine;
    std::string project, out;
    std::vector<std::string> experiments, dumps;
    InspectionFlags inspection;
    bool keep = false, show_progress = true;
    std::string json = {};  ///< file for all statistics, by experiment; "-": standard output
};

/// An experiment that cannot run does not keep the others from it; the status then says that the file is at
/// fault. Renders the chosen experiments (all when none is named) to OUT/ID.exr and OUT/ID.json, and a
/// preview OUT/ID.png.
int render_project(const ProjectRender& job);

}  // namespace ir::cli
