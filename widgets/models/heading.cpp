#include "widgets/models/heading.h"

namespace ir::widgets {

QVariant heading_alignment(const QAbstractItemModel& model, int column, const QModelIndex& parent) {
    for (int row = 0; row < model.rowCount(parent); ++row) {
        const auto cell = model.index(row, column, parent);
        if (!cell.data().toString().isEmpty()) return cell.data(Qt::TextAlignmentRole);
        const auto below = heading_alignment(model, column, model.index(row, 0, parent));
        if (below.isValid()) return below;
    }
    return {};
}

}  // namespace ir::widgets
