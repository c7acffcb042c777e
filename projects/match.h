#pragma once

#include <functional>
#include <string>

#include "projects/edits.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// Whether the files of a scene (its id) animate something by themselves, which the document does not tell.
/// Asked only where it matters.
using AnimatedScene = std::function<bool(const std::string& scene)>;

/// What the document does not tell of the scenes that its experiments use. Asked only where it matters.
struct SceneFacts {
    AnimatedScene is_animated;
    /// All that emits in an experiment (renderers/scene/light_sources.h); nothing where that is not known.
    std::function<std::vector<LightSource>(const Experiment& experiment)> light_sources =
        [](const Experiment&) { return std::vector<LightSource>(); };
};

/// Whether frames of other times show something else: camera, lights, parts, or what the scene animates.
bool is_moving(const Project& project, const Experiment& experiment, const AnimatedScene& is_animated);

/// Values for the method that is the reference, so that it computes the transport of `method` with `values`,
/// and leaves out what that method says to lack of it, as far as its own choice of sources goes
/// (light_use.h); what is missing there counts as that method's default, and what is no transport as the
/// reference's. Throws UsageError as matching_reference(), and where the reference cannot compute this
/// transport.
Settings matching_values(const MethodDescription& method, const Settings& values, const Registry& registry);

/// The ground truth in place of an experiment without presets: the method that is the reference with
/// matching_values(), at the time of the experiment's last frame; its samples per frame are the method's
/// default, in 16 frames, so that a first picture is there soon. Throws as matching_values().
Experiment ground_truth(Experiment run, const Registry& registry);

/// The experiment that is the ground truth of another one: same scene, camera, lights, size and transport, as
/// ground_truth(); its seed is that of new experiments, so that it is shared. Where something moves it is of
/// the last frame's moment, and a camera on a path, which an experiment sees at its own time, is where it is
/// then; elsewhere it is of the experiment's own time. Throws UsageError where this build has none, where the
/// experiment's method is unknown, or where the experiment is a reference itself.
Experiment matching_reference(const Project& project, const Experiment& experiment, const Registry& registry,
                              const AnimatedScene& is_animated);

/// *Match*: makes the experiment be judged by its ground truth, all in one step. An experiment of the project
/// that is that ground truth already, at any number of samples, and where nothing moves at any time, is
/// taken; else one is added behind it. The result names the experiment's reference when applied. Null when it
/// has that reference already.
EditPtr match(const Project& project, const std::string& experiment, const Registry& registry,
              const AnimatedScene& is_animated);

/// Ids of experiments whose reference differs from them in transport, sources of light, scene, camera,
/// lights, size or, where something moves, the time of their last frame, each with one line that says in
/// what.
std::vector<std::pair<std::string, std::string>> mismatched_references(const Project& project,
                                                                       const Registry& registry,
                                                                       const SceneFacts& facts);

}  // namespace ir::projects
