#pragma once

#include <optional>
#include <string>
#include <vector>

#include "projects/match.h"

namespace ir::engine {

/// One point of a study before it is rendered.
struct PlannedPoint {
    projects::Json value;      ///< of what the plot runs over
    projects::Experiment run;  ///< as it is to run
    int frames = 1;            ///< measured after so many
    std::string problem = {};  ///< not empty: it cannot be rendered, in one line
};

/// Points that one execution gives, one after the other: all frames of an experiment, or one value.
struct PlannedRun {
    std::string experiment;  ///< id
    std::vector<PlannedPoint> points;
};

/// What a plot asks for, in the order of experiments, then values. `project` has the content of the files as
/// they are (projects::with_contents). Points that cannot be had, by themselves or because the reference is
/// the truth of another transport, scene, camera, lighting, size or, where something moves, time, say why.
/// Throws UsageError (one line) where nothing can be measured at all: no experiments, unknown reference, key
/// or metric, no values.
std::vector<PlannedRun> plan_study(const projects::Project& project, const projects::ErrorPlot& plot,
                                   const projects::SceneFacts& facts);

/// Why a picture of `experiment` cannot be judged by one of `reference`, as mismatched_references() says it.
/// Empty: it can.
std::string why_not_judged_by(const projects::Project& project, const projects::Experiment& experiment,
                              const projects::Experiment& reference, const projects::SceneFacts& facts);

}  // namespace ir::engine
