#pragma once

#include <QString>

class QGridLayout;
class QWidget;

namespace ir::widgets {

/// A titled group that folds, added to the parent's box layout. Returns the grid for its rows: label, editor,
/// button.
QGridLayout* make_section(const QString& title, QWidget* parent);
/// The section that holds a row's widget, if it is folded.
void unfold_section_of(const QWidget& row);

}  // namespace ir::widgets
