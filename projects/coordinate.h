#pragma once

#include <string>
#include <vector>

#include "projects/document.h"
#include "projects/edits.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// What every experiment has besides its method's parameters and may vary: size, seed, frames, time, camera,
/// lights, scene.
const std::vector<std::string>& general_keys();

/// The experiment as it runs (presets applied) with one of general_keys() or a parameter of its method set to
/// `value`, of the types that the document uses; without a kept result. Throws UsageError with one line that
/// names the key for unknown keys, ids that the project does not have, and values that are not allowed.
Experiment with_coordinate(const Project& project, const Experiment& experiment, const std::string& key,
                           const Json& value, const Registry& registry);

namespace edits {

/// Values of such keys, an object, become the experiment's own, as set_values() and its like have it.
/// Throws UsageError.
EditPtr set_coordinates(const Project& project, const Registry& registry, const std::string& experiment,
                        const Json& coordinates, const std::string& label);

}  // namespace edits
}  // namespace ir::projects
