#include "widgets/models/number_order.h"

namespace ir::widgets {

NumberOrder::NumberOrder(int sort_role, QObject* parent) : QSortFilterProxyModel(parent) {
    setSortRole(sort_role);
    setSortCaseSensitivity(Qt::CaseInsensitive);
    setDynamicSortFilter(true);
}

bool NumberOrder::lessThan(const QModelIndex& a, const QModelIndex& b) const {
    const auto left = a.data(sortRole()), right = b.data(sortRole());
    if (left.isNull() != right.isNull())
        return sortOrder() == Qt::AscendingOrder ? right.isNull() : left.isNull();
    const bool are_numbers = left.typeId() == QMetaType::Double && right.typeId() == QMetaType::Double;
    return are_numbers ? left.toDouble() < right.toDouble() : QSortFilterProxyModel::lessThan(a, b);
}

}  // namespace ir::widgets
