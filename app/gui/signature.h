#pragma once

#include <string>

#include "app/engine/experiment.h"

namespace ir::gui {

/// Text that differs when the picture may: two equal ones need no new rendering.
std::string signature(const engine::Experiment& experiment);

}  // namespace ir::gui
