#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "renderers/core/shard.h"

namespace ir::cli {

/// What `plot` and `bench error` do.
struct ProjectPlots {
    MachineFlags machine;
    std::string project;
    std::vector<std::string> plots = {};  ///< ids; all where it is empty
    std::string json = {};                ///< file for all numbers, by plot; "-": standard output
    std::string csv = {};                 ///< file for the numbers of the only plot
    std::string svg = {};                 ///< file for the drawing of the only plot
    std::string metric = {};              ///< instead of the plots' own
    int repeats = 1;
    Shard shard = {};  ///< of the points
    bool keep = true, show_progress = true;
    bool merge = false;  ///< nothing is rendered: parts that shards have left are joined
};

/// Carries out plots of a project, prints a table of each, and keeps the numbers in results/plots. A plot
/// that cannot be carried out does not keep the others from it; the status then says that the file is at
/// fault. A shard has only its points, and writes them to files of its own (file_of_shard); the one
/// that ends last joins and keeps them, and writes the files themselves.
int plot_project(const ProjectPlots& job);

}  // namespace ir::cli
