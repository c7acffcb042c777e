#pragma once

#include <cstdint>

#include "projects/edits.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// Whether the method adds up samples in its history, so that a stored state can be continued and serves
/// every smaller number of samples: one of its parameters accumulates.
bool accumulates(const MethodDescription& method);

/// Seconds between two frames of a run.
inline constexpr double frame_seconds = 1.0 / 30;

/// Seconds at which the last frame of an experiment sees its scene: a method that accumulates adds all its
/// frames up at the experiment's time, others let frame_seconds pass between two frames.
double last_time(const Experiment& experiment, const Registry& registry);

/// What one frame adds: the product of the effective values of parameters that accumulate; 1 where there are
/// none.
std::uint64_t samples_per_frame(const MethodDescription& method, const Settings& values);

/// Samples in the picture of an experiment: effective frames times samples_per_frame. Frames alone for
/// methods that this build does not know.
std::uint64_t sample_count(const Experiment& experiment, const Registry& registry);

/// The experiment with as many samples as near to `samples` as its method allows, never fewer unless it
/// cannot hold them: in frames of as many samples as now where they divide, else in frames of about as many.
/// What the active preset overrides is changed there. Methods that do not accumulate come back as they are.
Experiment with_sample_count(const Experiment& experiment, std::uint64_t samples, const Registry& registry);

/// The same as a change of the document.
EditPtr set_sample_count(const Project& project, const std::string& experiment, std::uint64_t samples,
                         const Registry& registry);

}  // namespace ir::projects
