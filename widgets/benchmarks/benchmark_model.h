#pragma once

#include <QAbstractTableModel>
#include <optional>
#include <vector>

namespace ir::widgets {

struct BenchmarkCell {
    QString text;                  ///< empty: no number
    std::optional<double> number;  ///< by which it is sorted
    bool is_best = false;
    bool operator==(const BenchmarkCell&) const = default;
};

/// A variant or a peer of a benchmark, measured or not.
struct BenchmarkLine {
    enum class State { unmeasured, running, measured, failed };
    QString label, tip;
    QString problem;  ///< of one that failed, in one line
    State state = State::unmeasured;
    bool is_peer = false;  ///< runs with the variants: cannot be chosen
    bool is_chosen = true;
    std::vector<BenchmarkCell> cells;
    bool operator==(const BenchmarkLine&) const = default;
};

struct BenchmarkTable {
    QStringList headings, docs;  ///< of the columns behind the label's
    std::vector<BenchmarkLine> lines;
    bool operator==(const BenchmarkTable&) const = default;
};

/// Variants of a benchmark, one a row: the first column names and chooses them, the others are its numbers.
class BenchmarkModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Role { sort_role = Qt::UserRole };

    using QAbstractTableModel::QAbstractTableModel;
    /// Lines that stay, by their labels and number, keep their selection.
    void set_table(BenchmarkTable table);
    /// While it runs nobody chooses.
    void set_fixed(bool fixed) { fixed_ = fixed; }
    const BenchmarkTable& table() const { return table_; }

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  signals:
    void choice_changed();

  private:
    QVariant label_data(const BenchmarkLine& line, int role) const;
    BenchmarkTable table_;
    bool fixed_ = false;
};

}  // namespace ir::widgets
