#pragma once

#include <QString>

class QGridLayout;
class QWidget;

namespace ir::widgets {

/// A titled group that folds, added to the parent's box layout. Returns the grid for its rows: label, editor,
/// button.
QGridLayout* make_section(const QString& title, QWidget* parent);

}  // namespace ir::widgets
