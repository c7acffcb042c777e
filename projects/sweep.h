#pragma once

#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// One variation: the experiment to run, with a valid file name as its id ("base-0007"), and what varies.
struct SweepPoint {
    Experiment experiment;
    Json coordinates;  ///< {"samples": 16, "seed": 2}
};

inline constexpr std::size_t max_sweep_points = 100'000;

/// All variations, last axis fastest. Throws UsageError (one line) for unknown experiments, keys, or values
/// that the method refuses, and beyond max_sweep_points.
std::vector<SweepPoint> sweep_points(const Project& project, const Sweep& sweep, const Registry& registry);

/// How many points sweep_points() makes. Throws UsageError as it does, but looks at each value once, beside
/// the first values of the axes before: it takes no longer than the axes are.
std::size_t check_sweep(const Project& project, const Sweep& sweep, const Registry& registry);

/// Where a window puts what a sweep renders, relative to results/, '/' as separator. An
/// empty id gives the folder of all sweeps.
std::string sweep_path(const std::string& sweep);

}  // namespace ir::projects
