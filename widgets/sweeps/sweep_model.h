#pragma once

#include <QAbstractTableModel>
#include <optional>
#include <vector>

namespace ir::widgets {

struct SweepCell {
    QString text;                       ///< empty: there is none
    std::optional<double> number = {};  ///< by which it is sorted; else by its text
    bool operator==(const SweepCell&) const = default;
};

/// A variation of a sweep.
struct SweepLine {
    enum class State { waiting, running, done, stale, failed };
    QString id, name;  ///< name: "directions = 64, seed = 2"
    State state = State::waiting;
    QString problem;               ///< why it failed, or why it has no picture, in one line
    std::vector<SweepCell> cells;  ///< as many as there are headings
    QString picture, reference;    ///< EXR files; empty: none
    QString version;               ///< another one: the files hold another picture
    bool operator==(const SweepLine&) const = default;
};

struct SweepRows {
    QStringList headings, docs;
    int axes = 0;  ///< so many of the first headings are what varies; numbers follow
    std::vector<SweepLine> lines;
    bool operator==(const SweepRows&) const = default;
};

/// The variations of a sweep, one a row: the first column numbers them, the others are the cells.
class SweepModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Role { sort_role = Qt::UserRole, id_role };

    using QAbstractTableModel::QAbstractTableModel;
    /// Where ids and headings stay, so does the selection.
    void set_rows(SweepRows rows);
    /// One line instead of the one with its id; nothing where there is none.
    void set_line(int row, SweepLine line);
    const SweepRows& rows() const { return rows_; }
    const SweepLine& line(int row) const { return rows_.lines[std::size_t(row)]; }
    /// Of the first column; invalid: there is none.
    QModelIndex index_of(const QString& id) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    SweepRows rows_;
};

/// What people are told of a state.
QString state_text(SweepLine::State state);

}  // namespace ir::widgets
