#pragma once

#include <QByteArray>
#include <QImage>

#include "app/gui/workspace.h"

namespace ir::gui {

/// Without what surrounds it; what is not a picture, as it is seen. Null: a table.
QImage picture_of(widgets::ViewPane& pane);
/// The part of a picture with the shape of `size`, as large as it may be, where most is seen.
QImage with_shape(const QImage& picture, QSize size);
/// A view as a card has it: small, also as a file. Of those that show something the first; of what was set up
/// rather one that shows more than a picture. Empty where there is none.
QByteArray card_of(Workspace& workspace, bool is_set_up = false);

}  // namespace ir::gui
