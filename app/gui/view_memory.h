#pragma once

#include "projects/json.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// A view's state in session.json.
projects::Json to_json(const widgets::ViewState& state);
/// What is missing or odd keeps its default.
widgets::ViewState view_state_from_json(const projects::Json& json);

projects::Json to_json(const widgets::CameraPose& pose);
std::optional<widgets::CameraPose> pose_from_json(const projects::Json& json);

}  // namespace ir::gui
