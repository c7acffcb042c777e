#pragma once

#include <QAbstractTableModel>
#include <QDateTime>
#include <QSortFilterProxyModel>
#include <vector>

namespace ir::widgets {

/// A kept result, as a row shows it.
struct ResultRow {
    enum class State {
        current,  ///< what its experiment would render now
        stale,    ///< its experiment would render something else now
        orphan,   ///< its experiment is gone
        missing   ///< its picture is not on the disk
    };
    QString key;  ///< of the result
    QString experiment, method;
    State state = State::current;
    qint64 samples = -1;  ///< -1: the method has no such parameter
    qint64 frames = 1;
    QDateTime date;      ///< invalid: not known
    qint64 bytes = 0;    ///< on the disk
    bool grows = false;  ///< with its stored state: more samples go on from these
    QString device, build;
    bool operator==(const ResultRow&) const = default;
};

QString state_name(ResultRow::State state);

/// Kept results, one a row.
class ResultsModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column {
        experiment_column,
        method_column,
        state_column,
        samples_column,
        frames_column,
        date_column,
        bytes_column,
        device_column,
        build_column,
        column_count
    };
    enum Role { key_role = Qt::UserRole, sort_role };

    using QAbstractTableModel::QAbstractTableModel;
    /// Rows that stay, by their keys, keep their selection.
    void set_rows(std::vector<ResultRow> rows);
    const std::vector<ResultRow>& rows() const { return rows_; }
    const ResultRow* find(const QString& key) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    QString text(const ResultRow& row, int column) const;
    QString tip(const ResultRow& row) const;
    QVariant sorted_by(const ResultRow& row, int column) const;
    std::vector<ResultRow> rows_;
};

/// Rows that contain all words of a text in some column.
class ResultsFilter : public QSortFilterProxyModel {
    Q_OBJECT
  public:
    explicit ResultsFilter(QObject* parent = nullptr);
    void set_text(const QString& text);

  protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

  private:
    QStringList words_;
};

}  // namespace ir::widgets
