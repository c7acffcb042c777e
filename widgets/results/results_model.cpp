#include "widgets/results/results_model.h"

#include <QGuiApplication>
#include <QLocale>
#include <QPalette>
#include <algorithm>

#include "widgets/models/heading.h"
#include "widgets/style/icons.h"

namespace ir::widgets {

using State = ResultRow::State;

QString state_name(State state) {
    switch (state) {
        case State::current:
            return ResultsModel::tr("Current");
        case State::stale:
            return ResultsModel::tr("Stale");
        case State::orphan:
            return ResultsModel::tr("No experiment");
        case State::missing:
            return ResultsModel::tr("Missing");
    }
    return {};
}

namespace {

QString state_help(State state) {
    switch (state) {
        case State::current:
            return ResultsModel::tr("Its experiment would render the same now.");
        case State::stale:
            return ResultsModel::tr(
                "Its experiment would render something else now. “What changed” says why.");
        case State::orphan:
            return ResultsModel::tr("The experiment that it was kept of is no longer in the project.");
        case State::missing:
            return ResultsModel::tr("Its picture is no longer on the disk.");
    }
    return {};
}

}  // namespace

void ResultsModel::set_rows(std::vector<ResultRow> rows) {
    const auto same_keys = std::equal(rows.begin(), rows.end(), rows_.begin(), rows_.end(),
                                      [](const auto& a, const auto& b) { return a.key == b.key; });
    if (same_keys) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i] == rows_[i]) continue;
            rows_[i] = std::move(rows[i]);
            emit dataChanged(index(int(i), 0), index(int(i), column_count - 1));
        }
        return;
    }
    // Rows that are gone go first, then the rest is added or changed in its place.
    const auto kept = [&](const ResultRow& row) {
        return std::any_of(rows.begin(), rows.end(), [&](const auto& each) { return each.key == row.key; });
    };
    for (int i = int(rows_.size()) - 1; i >= 0; --i) {
        if (kept(rows_[std::size_t(i)])) continue;
        beginRemoveRows({}, i, i);
        rows_.erase(rows_.begin() + i);
        endRemoveRows();
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i < rows_.size() && rows_[i].key == rows[i].key) {
            if (rows_[i] == rows[i]) continue;
            rows_[i] = std::move(rows[i]);
            emit dataChanged(index(int(i), 0), index(int(i), column_count - 1));
            continue;
        }
        if (find(rows[i].key)) {  // in another order than before
            beginResetModel();
            rows_.erase(rows_.begin() + std::ptrdiff_t(i), rows_.end());
            std::move(rows.begin() + std::ptrdiff_t(i), rows.end(), std::back_inserter(rows_));
            endResetModel();
            return;
        }
        beginInsertRows({}, int(i), int(i));
        rows_.insert(rows_.begin() + std::ptrdiff_t(i), std::move(rows[i]));
        endInsertRows();
    }
}

const ResultRow* ResultsModel::find(const QString& key) const {
    const auto found =
        std::find_if(rows_.begin(), rows_.end(), [&](const auto& row) { return row.key == key; });
    return found == rows_.end() ? nullptr : &*found;
}

int ResultsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(rows_.size());
}

int ResultsModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QString ResultsModel::text(const ResultRow& row, int column) const {
    const QLocale locale;
    switch (column) {
        case experiment_column:
            return row.experiment;
        case method_column:
            return row.method;
        case state_column:
            return state_name(row.state);
        case samples_column:
            return row.samples < 0 ? QString() : locale.toString(row.samples);
        case frames_column:
            return locale.toString(row.frames);
        case date_column:
            return row.date.isValid() ? row.date.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm"))
                                      : QString();
        case bytes_column:
            return locale.formattedDataSize(row.bytes, 1);
        case device_column:
            return row.device;
        case build_column:
            return row.build;
        default:
            return {};
    }
}

QString ResultsModel::tip(const ResultRow& row) const {
    QStringList lines{QStringLiteral("%1 · %2").arg(row.experiment, row.method), state_help(row.state)};
    if (row.grows) lines << tr("Its state is kept: more samples go on from these.");
    lines << tr("Kept %1 by %2 on %3")
                 .arg(text(row, date_column), row.build.isEmpty() ? tr("an unknown build") : row.build,
                      row.device.isEmpty() ? tr("an unknown device") : row.device);
    return lines.join(QLatin1Char('\n'));
}

QVariant ResultsModel::sorted_by(const ResultRow& row, int column) const {
    switch (column) {
        case state_column:
            return int(row.state);
        case samples_column:
            return row.samples;
        case frames_column:
            return row.frames;
        case date_column:
            return row.date;
        case bytes_column:
            return row.bytes;
        default:
            return text(row, column);
    }
}

QVariant ResultsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= int(rows_.size())) return {};
    const auto& row = rows_[std::size_t(index.row())];
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
            return text(row, column);
        case Qt::ToolTipRole:
            return tip(row);
        case Qt::TextAlignmentRole:
            return int(Qt::AlignVCenter |
                       (column == samples_column || column == frames_column || column == bytes_column
                            ? Qt::AlignRight
                            : Qt::AlignLeft));
        case Qt::DecorationRole:
            if (column != state_column || row.state == State::current) return {};
            return icon(row.state == State::missing ? "error"
                        : row.state == State::stale ? "warning"
                                                    : "note");
        case Qt::ForegroundRole:
            if (row.state != State::current && column != state_column)
                return QGuiApplication::palette().color(QPalette::PlaceholderText);
            return {};
        case key_role:
            return row.key;
        case sort_role:
            return sorted_by(row, column);
        default:
            return {};
    }
}

QVariant ResultsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= column_count) return {};
    if (role == Qt::TextAlignmentRole) return heading_alignment(*this, section);
    if (role == Qt::DisplayRole)
        return QStringList{tr("Experiment"), tr("Method"), tr("State"),  tr("Samples"), tr("Frames"),
                           tr("Kept"),       tr("Size"),   tr("Device"), tr("Build")}
            .at(section);
    if (role == Qt::ToolTipRole)
        return QStringList{tr("The experiment that it is the picture of, as it is called now"),
                           tr("The method that rendered it"),
                           tr("Whether its experiment would render the same now"),
                           tr("Samples per pixel, where the method counts them"),
                           tr("Frames from an empty history"),
                           tr("When it was kept"),
                           tr("Of its files on the disk"),
                           tr("What rendered it"),
                           tr("The program that rendered it")}
            .at(section);
    return {};
}

ResultsFilter::ResultsFilter(QObject* parent) : QSortFilterProxyModel(parent) {
    setSortRole(ResultsModel::sort_role);
    setSortCaseSensitivity(Qt::CaseInsensitive);
}

void ResultsFilter::set_text(const QString& text) {
    words_ = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    invalidateFilter();
}

bool ResultsFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    QStringList line;
    for (int column = 0; column < sourceModel()->columnCount(parent); ++column)
        line << sourceModel()->index(row, column, parent).data().toString();
    const QString all = line.join(QLatin1Char('\n'));
    return std::all_of(words_.begin(), words_.end(),
                       [&](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
}

}  // namespace ir::widgets
