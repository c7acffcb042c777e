#pragma once

#include <vector>

#include "app/gui/workspace.h"
#include "widgets/profile/region_numbers.h"

namespace ir::gui {

struct SeenPicture {
    widgets::ShownPicture shown;
    widgets::Display display;
};

/// Pictures of all open views, each once, under names that tell them apart; the difference where one is
/// shown alone. `awaits`: of some there is only a draft.
std::vector<SeenPicture> shown_pictures(Workspace& workspace, bool& awaits);

}  // namespace ir::gui
