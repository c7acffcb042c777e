#pragma once

#include <QAbstractTableModel>

#include "renderers/plot/plot_data.h"

namespace ir::widgets {

/// The points of a plot, one a row, in the order in which they are read. The first column has the series'
/// marks.
class PlotTableModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Role { id_role = Qt::UserRole, sort_role };

    using QAbstractTableModel::QAbstractTableModel;
    void set_data(const PlotData& data);
    QModelIndex index_of(const QString& id) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    struct Row {
        PlotPoint point;
        int series = 0;
        bool operator==(const Row&) const = default;
    };
    std::vector<std::string> headings_;
    std::vector<Row> rows_;
};

}  // namespace ir::widgets
