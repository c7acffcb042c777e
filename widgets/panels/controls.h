#pragma once

#include <QString>
#include <vector>

#include "widgets/parameters/option.h"

class QAbstractItemModel;
class QBoxLayout;
class QComboBox;
class QEvent;
class QItemSelectionModel;
class QLabel;
class QProgressBar;
class QPushButton;
class QToolButton;
class QWidget;

/// What panels make their controls of.
namespace ir::widgets {

/// What a control does, and why it cannot.
QString tip_with(const QString& tip, const QString& why_not);
/// A label that is cut, with an ellipsis, rather than widening the panel.
QLabel* make_cut_label(const char* name, Qt::TextElideMode cut = Qt::ElideRight);
/// A button in a panel's row, with its text beside the drawing; without a drawing it is the text alone. Its
/// tool tip is the text until another one is set.
QToolButton* add_button(QBoxLayout* row, const char* name, const char* drawing, const QString& text);
/// One that shows the drawing alone.
QToolButton* add_icon_button(QBoxLayout* row, const char* name, const char* drawing, const QString& text);
/// A list in a panel's row that is as wide as so many letters at least. Its tool tip is the label.
QComboBox* add_list(QBoxLayout* row, const char* name, const QString& label, int letters, int stretch = 1);
/// Gives a list the keys that move through it while a line to search it has the keyboard; whether this was
/// one.
bool moves_through(QWidget* list, QEvent* event);
/// How far a panel's work is, in thousandths.
QProgressBar* add_progress(QBoxLayout* row);

/// What a panel shows in place of its content, and what a person may do about it; tests find both by the
/// names "empty" and "empty-button".
struct EmptyPage {
    QWidget* page;
    QLabel* text;
    QPushButton* button;
    /// The button is there only where it has a text.
    void show(const QString& what, const QString& offered) const;
};
EmptyPage make_empty_page();

/// Fills a list and chooses in it; touches it only where something differs. Emits no `activated`.
void show_options(QComboBox* list, const std::vector<Option>& options, const QString& current);

/// The chosen rows of a table, or all, in the order shown: headings first, with tabs between cells.
QString rows_as_text(const QAbstractItemModel& model, const QItemSelectionModel& selection);

}  // namespace ir::widgets
