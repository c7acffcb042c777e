#include "widgets/benchmarks/benchmark_model.h"

#include <QFont>
#include <QGuiApplication>
#include <QPalette>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

using State = BenchmarkLine::State;

bool same_shape(const BenchmarkTable& a, const BenchmarkTable& b) {
    if (a.headings.size() != b.headings.size() || a.lines.size() != b.lines.size()) return false;
    for (std::size_t i = 0; i < a.lines.size(); ++i)
        if (a.lines[i].label != b.lines[i].label) return false;
    return true;
}

QString state_text(const BenchmarkLine& line) {
    switch (line.state) {
        case State::running:
            return BenchmarkModel::tr("It is being measured.");
        case State::failed:
            return line.problem;
        case State::measured:
            return {};
        case State::unmeasured:
            return line.is_peer ? BenchmarkModel::tr("Runs with the variants.")
                                : BenchmarkModel::tr("Not measured yet. Checked variants run.");
    }
    return {};
}

}  // namespace

void BenchmarkModel::set_table(BenchmarkTable table) {
    if (table == table_) return;
    if (!same_shape(table, table_)) {
        beginResetModel();
        table_ = std::move(table);
        endResetModel();
        return;
    }
    const bool other_headings = table.headings != table_.headings || table.docs != table_.docs;
    table_ = std::move(table);
    if (other_headings) emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
    if (rowCount() > 0) emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
}

int BenchmarkModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(table_.lines.size());
}

int BenchmarkModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : 1 + int(table_.headings.size());
}

QVariant BenchmarkModel::label_data(const BenchmarkLine& line, int role) const {
    switch (role) {
        case Qt::DisplayRole:
            return line.state == State::failed ? QStringLiteral("%1:  %2").arg(line.label, line.problem)
                   : line.is_peer              ? tr("%1 (peer)").arg(line.label)
                                               : line.label;
        case sort_role:
            return line.label;
        case Qt::CheckStateRole:
            return line.is_peer ? QVariant() : QVariant(line.is_chosen ? Qt::Checked : Qt::Unchecked);
        case Qt::DecorationRole:
            if (line.state == State::running) return icon("play");
            return line.state == State::failed ? QVariant(icon("error")) : QVariant();
        case Qt::ForegroundRole:
            if (line.state == State::measured || line.state == State::running) return {};
            return QGuiApplication::palette().color(QPalette::PlaceholderText);
        default:
            return {};
    }
}

QVariant BenchmarkModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) return {};
    const auto& line = table_.lines[std::size_t(index.row())];
    if (role == Qt::ToolTipRole) {
        QStringList text{line.label};
        for (const auto& more : {state_text(line), line.tip})
            if (!more.isEmpty()) text << more;
        return text.join(QLatin1Char('\n'));
    }
    if (index.column() == 0) return label_data(line, role);
    const auto column = std::size_t(index.column() - 1);
    if (column >= line.cells.size()) return {};
    const auto& cell = line.cells[column];
    switch (role) {
        case Qt::DisplayRole:
            return cell.text;
        case sort_role:
            return cell.number ? QVariant(*cell.number) : QVariant();
        case Qt::TextAlignmentRole:
            return int(Qt::AlignRight | Qt::AlignVCenter);
        case Qt::FontRole: {
            if (!cell.is_best) return {};
            QFont bold;
            bold.setBold(true);
            return bold;
        }
        default:
            return {};
    }
}

bool BenchmarkModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (role != Qt::CheckStateRole || !(flags(index) & Qt::ItemIsUserCheckable)) return false;
    auto& line = table_.lines[std::size_t(index.row())];
    line.is_chosen = value.toInt() == Qt::Checked;
    emit dataChanged(index, index);
    emit choice_changed();
    return true;
}

Qt::ItemFlags BenchmarkModel::flags(const QModelIndex& index) const {
    auto flags = QAbstractTableModel::flags(index);
    if (!index.isValid() || index.column() != 0) return flags;
    if (!fixed_ && !table_.lines[std::size_t(index.row())].is_peer) flags |= Qt::ItemIsUserCheckable;
    return flags;
}

QVariant BenchmarkModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
    if (role == Qt::TextAlignmentRole)
        return int((section == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    if (role == Qt::DisplayRole) return section == 0 ? tr("Variant") : table_.headings.value(section - 1);
    if (role == Qt::ToolTipRole)
        return section == 0 ? tr("What is compared; checked variants run") : table_.docs.value(section - 1);
    return {};
}

}  // namespace ir::widgets
