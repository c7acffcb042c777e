#pragma once

#include "projects/document.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// What to hand to the method: the experiment's effective values (active preset applied), completed with
/// defaults, without keys that the method does not know.
Settings runnable_settings(const Experiment& experiment, const MethodDescription& method);

}  // namespace ir::projects
