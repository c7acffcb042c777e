#pragma once

#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// What the key of a plot may be: "frames", "seed", and the parameters of its experiments' methods.
std::vector<std::string> plot_keys(const Project& project, const ErrorPlot& plot, const Registry& registry);

/// Frames after which an experiment is measured where a plot names none: 1, 2, 4, … and `frames` itself.
std::vector<int> doubling_frames(int frames);

/// How many points the plot has, of experiments that are in the project.
std::size_t count_points(const Project& project, const ErrorPlot& plot);

/// Where the numbers of a plot are kept, relative to results/, '/' as separator.
std::string study_path(const std::string& plot);

}  // namespace ir::projects
