#pragma once

#include <QByteArray>
#include <QImage>

#include "app/gui/workspace.h"

namespace ir::gui {

/// Without what surrounds it; what is not a picture, as it is seen. Null: a table.
QImage picture_of(widgets::ViewPane& pane);
/// The part of a picture with the shape of `size`, as large as it may be, where most is seen.
QImage with_shape(const QImage& picture, QSize size);
/// A view as a card of the start page has it: small, also as a file. Of those that show something the first,
/// or the last. Empty where there is none.
QByteArray card_of(Workspace& workspace, bool last = false);

}  // namespace ir::gui
