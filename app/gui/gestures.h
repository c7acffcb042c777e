#pragma once

#include <QList>
#include <QPair>
#include <QString>

namespace ir::gui {

/// What is done with the mouse, or with keys that are no action's: what it does, and how.
QList<QPair<QString, QString>> gestures();

}  // namespace ir::gui
