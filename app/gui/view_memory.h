#pragma once

#include "projects/json.h"
#include "renderers/core/inspection.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// A view's state in session.json.
projects::Json to_json(const widgets::ViewState& state);
/// What is missing or odd keeps its default.
widgets::ViewState view_state_from_json(const projects::Json& json);

/// What a person points at, with the views that show it.
projects::Json to_json(const Inspection& inspection);
Inspection inspection_from_json(const projects::Json& json);

/// The rectangle that is measured, with the size of the pictures that it is of.
projects::Json to_json(QSize size, const QRect& region);
std::pair<QSize, QRect> region_from_json(const projects::Json& json);  ///< empty where odd
/// Likewise the line whose values are plotted.
projects::Json to_json(QSize size, const QLine& line);
std::pair<QSize, QLine> line_from_json(const projects::Json& json);

projects::Json to_json(const widgets::CameraPose& pose);
std::optional<widgets::CameraPose> pose_from_json(const projects::Json& json);

}  // namespace ir::gui
