#pragma once

#include <QString>

class QGridLayout;
class QLabel;
class QWidget;

namespace ir::widgets {

/// A titled group that folds, added to the parent's box layout. Returns the grid for its rows: label, editor,
/// button.
QGridLayout* make_section(const QString& title, QWidget* parent);
/// The section that holds a row's widget, if it is folded.
void unfold_section_of(const QWidget& row);

/// What a panel says in place of its content, in the middle; tests find it by the name "empty".
QLabel* make_empty_text(QWidget* parent);

}  // namespace ir::widgets
