#pragma once

#include <string>
#include <vector>

#include "app/gui/view_model.h"

/// Showing something without covering what is looked at.
namespace ir::gui {

/// An output in another view than the active one, which stays as it is.
void show_beside(ViewModel& views, widgets::ViewArea& area, const std::string& owner, const std::string& key);
/// Puts buffers that stand in space into views, those of each space (widgets::Space) into one: one that shows
/// it already, else another than the active one.
void show_in_space(ViewModel& views, widgets::ViewArea& area, const std::string& owner,
                   const std::vector<std::string>& keys);

}  // namespace ir::gui
