#include "widgets/sweeps/sweep_model.h"

#include <algorithm>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

const char* drawing_of(SweepLine::State state) {
    switch (state) {
        case SweepLine::State::running:
            return "play";
        case SweepLine::State::stale:
            return "warning";
        case SweepLine::State::failed:
            return "error";
        case SweepLine::State::waiting:
        case SweepLine::State::done:
            break;
    }
    return nullptr;
}

bool have_same_ids(const SweepRows& a, const SweepRows& b) {
    return a.headings == b.headings && a.lines.size() == b.lines.size() &&
           std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(),
                      [](const SweepLine& one, const SweepLine& other) { return one.id == other.id; });
}

}  // namespace

QString state_text(SweepLine::State state) {
    switch (state) {
        case SweepLine::State::waiting:
            return SweepModel::tr("not rendered yet");
        case SweepLine::State::running:
            return SweepModel::tr("is being rendered");
        case SweepLine::State::stale:
            return SweepModel::tr("stale: it would be another picture now");
        case SweepLine::State::failed:
            return SweepModel::tr("failed");
        case SweepLine::State::done:
            break;
    }
    return {};
}

void SweepModel::set_rows(SweepRows rows) {
    if (!have_same_ids(rows, rows_)) {
        beginResetModel();
        rows_ = std::move(rows);
        endResetModel();
        return;
    }
    for (std::size_t i = 0; i < rows.lines.size(); ++i) set_line(int(i), std::move(rows.lines[i]));
    rows_.docs = std::move(rows.docs);
}

void SweepModel::set_line(int row, SweepLine line) {
    if (row < 0 || row >= rowCount()) return;
    auto& shown = rows_.lines[std::size_t(row)];
    if (shown.id != line.id || shown == line) return;
    shown = std::move(line);
    emit dataChanged(index(row, 0), index(row, columnCount() - 1));
}

QModelIndex SweepModel::index_of(const QString& id) const {
    const auto& lines = rows_.lines;
    const auto found =
        std::find_if(lines.begin(), lines.end(), [&](const SweepLine& line) { return line.id == id; });
    return found == lines.end() ? QModelIndex() : index(int(found - lines.begin()), 0);
}

int SweepModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(rows_.lines.size());
}

int SweepModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : 1 + int(rows_.headings.size());
}

QVariant SweepModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const auto& line = rows_.lines[std::size_t(index.row())];
    if (role == id_role) return line.id;
    if (role == Qt::ToolTipRole) {
        QStringList lines{line.name};
        if (line.state != SweepLine::State::failed) lines << state_text(line.state);
        lines << line.problem << tr("A click on its picture, or Enter, loads this setting");
        lines.removeAll(QString());
        return lines.join(QLatin1Char('\n'));
    }
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
    if (index.column() == 0) {
        if (role == Qt::DisplayRole) return index.row() + 1;
        if (role == sort_role) return double(index.row());
        if (role == Qt::AccessibleTextRole) return line.name;
        if (role == Qt::DecorationRole)
            if (const char* drawing = drawing_of(line.state)) return icon(drawing);
        return {};
    }
    const std::size_t column = std::size_t(index.column()) - 1;
    if (column >= line.cells.size()) return {};
    const auto& cell = line.cells[column];
    if (role == Qt::DisplayRole) return cell.text;
    if (role != sort_role) return {};
    if (cell.number) return *cell.number;
    return cell.text.isEmpty() ? QVariant() : QVariant(cell.text);
}

QVariant SweepModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
    if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
    if (role == Qt::DisplayRole) return section == 0 ? tr("№") : rows_.headings.value(section - 1);
    if (role == Qt::ToolTipRole)
        return section == 0 ? tr("Number in the sweep's order") : rows_.docs.value(section - 1);
    return {};
}

}  // namespace ir::widgets
