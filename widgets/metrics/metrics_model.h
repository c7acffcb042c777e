#pragma once

#include <QAbstractTableModel>
#include <memory>
#include <vector>

#include "widgets/metrics/metrics_worker.h"

namespace ir::widgets {

/// Numbers of one pair of pictures, and what they were before the last change.
struct MetricsHistory {
    std::shared_ptr<const MetricsResult> now;      ///< null: none yet
    std::shared_ptr<const MetricsResult> settled;  ///< the newest complete one of this pair
    std::shared_ptr<const MetricsResult> before;   ///< the last complete one of the generation before
    /// Takes an answer in: another pair forgets, another generation makes the last one "before".
    void take(std::shared_ptr<const MetricsResult> result);
    void clear() { *this = {}; }
};

/// A row a metric, best known first: of each pair the whole picture, the rectangle, and both before the last
/// change.
class MetricsModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { name_column, image_column, image_before, rectangle_column, rectangle_before, columns };
    using QAbstractTableModel::QAbstractTableModel;

    struct Pair {
        MetricsHistory history = {};
        QString name = {}, doc = {};  ///< "A − B", and what that is
        QString refusal = {};         ///< not empty: why it is not measured
    };
    /// One or more.
    void show(std::vector<Pair> pairs);
    /// Of a pair, from 0 on.
    static int column_of(int pair, Column column) { return pair * (columns - 1) + column; }
    bool has_rectangle() const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

    /// The number in a cell; absent where there is none.
    std::optional<double> value(int row, int column) const;

  private:
    QString tooltip(int row, int column) const;
    int trend(int row, int column) const;
    /// Of an earlier frame, while the slower metrics of this one are still being measured.
    std::optional<double> last_value(int row, int column) const;
    const Pair& pair_of(int column) const;
    std::vector<Pair> pairs_{1};
};

/// "0.01234", "34.1 dB", "∞" of equal pictures, "–" where no pixel was compared.
QString metric_text(const MetricDescription& metric, double value);
/// 1 better, -1 worse, 0 as good or not comparable.
int improvement(const MetricDescription& metric, double before, double now);

}  // namespace ir::widgets
