#pragma once

#include <string>

#include "projects/edits.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// Values for the method that is the reference, so that it computes the transport of `method` with `values`;
/// what is missing there counts as that method's default, and what is no transport as the reference's. Throws
/// UsageError as matching_reference(), and where the reference cannot compute this transport.
Settings matching_values(const MethodDescription& method, const Settings& values, const Registry& registry);

/// The ground truth in place of an experiment without presets: the method that is the reference with
/// matching_values(), at the time of the experiment's last frame; its samples per frame are the method's
/// default, in 16 frames, so that a first picture is there soon. Throws as matching_values().
Experiment ground_truth(Experiment run, const Registry& registry);

/// The experiment that is the ground truth of another one: same scene, camera, lights, size and transport, as
/// ground_truth(); its seed is that of new experiments, so that it is shared. Where the camera is on a path,
/// which an experiment sees at its own time, that time is kept: it is then no
/// truth of later frames of a scene that moves as well. Throws UsageError where this build has none, where
/// the experiment's method is unknown, or where the experiment is a reference itself.
Experiment matching_reference(const Project& project, const Experiment& experiment, const Registry& registry);

/// *Match*: makes the experiment be judged by its ground truth, all in one step. An experiment of the project
/// that is that ground truth already, at any number of samples, is taken; else one is added behind it. The
/// result names the experiment's reference when applied. Null when it has that reference already.
EditPtr match(const Project& project, const std::string& experiment, const Registry& registry);

/// Id of the experiment that match() would take or add.
std::string match_id(const Project& project, const std::string& experiment, const Registry& registry);

/// Ids of experiments whose reference differs from them in transport, scene, camera, lights, size or the
/// time of their last frame, each with one line that says in what.
std::vector<std::pair<std::string, std::string>> mismatched_references(const Project& project,
                                                                       const Registry& registry);

}  // namespace ir::projects
