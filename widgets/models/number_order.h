#pragma once

#include <QSortFilterProxyModel>

namespace ir::widgets {

/// Sorted by what the sort role gives, numbers or texts; rows without it stand last in either order.
class NumberOrder : public QSortFilterProxyModel {
    Q_OBJECT
  public:
    explicit NumberOrder(int sort_role, QObject* parent = nullptr);

  protected:
    bool lessThan(const QModelIndex& a, const QModelIndex& b) const override;
};

}  // namespace ir::widgets
