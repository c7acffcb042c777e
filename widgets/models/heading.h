#pragma once

#include <QAbstractItemModel>

namespace ir::widgets {

/// A heading stands as the cells below it do: as the first one that says something, in rows and in theirs.
QVariant heading_alignment(const QAbstractItemModel& model, int column, const QModelIndex& parent = {});

}  // namespace ir::widgets
