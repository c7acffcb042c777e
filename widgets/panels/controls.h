#pragma once

#include <QString>
#include <vector>

#include "widgets/parameters/option.h"

class QAbstractItemModel;
class QComboBox;
class QItemSelectionModel;
class QLabel;

/// What panels make their controls of.
namespace ir::widgets {

/// What a control does, and why it cannot.
QString tip_with(const QString& tip, const QString& why_not);
/// A label that is cut rather than widening the panel.
QLabel* make_cut_label(const char* name);
/// Fills a list and chooses in it; touches it only where something differs. Emits no `activated`.
void show_options(QComboBox* list, const std::vector<Option>& options, const QString& current);

/// The chosen rows of a table, or all, in the order shown: headings first, with tabs between cells.
QString rows_as_text(const QAbstractItemModel& model, const QItemSelectionModel& selection);

}  // namespace ir::widgets
