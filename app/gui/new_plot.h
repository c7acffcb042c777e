#pragma once

#include <string>

#include "renderers/core/method.h"
#include "widgets/document/edit_maker.h"

namespace ir::gui {

/// Adds a plot of the error against time: all experiments that are judged by the same reference as
/// `experiment` (or, where that has none, as the first that has one), over frames.
widgets::EditMaker add_error_plot(const Registry& registry, const std::string& experiment);

}  // namespace ir::gui
