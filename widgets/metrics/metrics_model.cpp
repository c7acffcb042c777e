#include "widgets/metrics/metrics_model.h"

#include <QColor>
#include <QGuiApplication>
#include <QPalette>
#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

const QColor better_colour(126, 196, 120), worse_colour(232, 138, 96);

std::optional<double> value_of(const MetricResult& result, const std::string& metric) {
    const auto found = result.values.find(metric);
    return found == result.values.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> value_in(const MetricsResult* result, const std::string& metric, bool rectangle) {
    if (!result || !result->refusal.isEmpty()) return {};
    if (!rectangle) return value_of(result->image, metric);
    return result->rectangle ? value_of(*result->rectangle, metric) : std::nullopt;
}

/// What a column shows, of whatever pair.
int kind_of(int column) {
    return column <= 0 ? MetricsModel::name_column : (column - 1) % (MetricsModel::columns - 1) + 1;
}

QString q(const std::string& text) {
    return QString::fromStdString(text);
}

}  // namespace

void MetricsHistory::take(std::shared_ptr<const MetricsResult> result) {
    if (now && now->request.pair != result->request.pair) clear();
    now = result;
    if (!result->refusal.isEmpty()) return;
    if (settled && settled->request.generation != result->request.generation) before = settled;
    if (result->complete) settled = std::move(result);
}

QString metric_text(const MetricDescription& metric, double value) {
    if (std::isnan(value)) return QStringLiteral("–");
    if (std::isinf(value)) return value > 0 ? QStringLiteral("∞") : QStringLiteral("−∞");
    if (metric.unit == "dB") return QString::number(value, 'f', 2) + QStringLiteral(" dB");
    return QString::number(value, 'g', 4);
}

int improvement(const MetricDescription& metric, double before, double now) {
    const double change = badness(metric, now) - badness(metric, before);
    return change < 0 ? 1 : change > 0 ? -1 : 0;  // NaN is neither
}

void MetricsModel::show(std::vector<Pair> pairs) {
    if (pairs.empty()) pairs.resize(1);
    const bool is_other_shape = pairs.size() != pairs_.size();
    if (is_other_shape) beginResetModel();
    pairs_ = std::move(pairs);
    if (is_other_shape) return endResetModel();
    emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
    emit headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
}

const MetricsModel::Pair& MetricsModel::pair_of(int column) const {
    return pairs_[std::size_t(std::max(0, column - 1) / (columns - 1))];
}

bool MetricsModel::has_rectangle() const {
    return std::any_of(pairs_.begin(), pairs_.end(), [](const Pair& pair) {
        return pair.history.now && pair.history.now->rectangle.has_value();
    });
}

int MetricsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(metrics().size());
}

int MetricsModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_of(int(pairs_.size()), name_column) + 1;
}

std::optional<double> MetricsModel::value(int row, int column) const {
    if (row < 0 || row >= rowCount() || column < 0 || column >= columnCount()) return {};
    const auto& history = pair_of(column).history;
    if (!history.now || !history.now->refusal.isEmpty()) return {};
    const auto& name = metrics()[std::size_t(row)].name;
    const int kind = kind_of(column);
    const bool rectangle = kind == rectangle_column || kind == rectangle_before;
    const bool same_rectangle =
        history.before && history.before->request.rectangle == history.now->request.rectangle;
    if (kind == image_before || kind == rectangle_before)
        return rectangle && !same_rectangle ? std::nullopt : value_in(history.before.get(), name, rectangle);
    return value_in(history.now.get(), name, rectangle);
}

std::optional<double> MetricsModel::last_value(int row, int column) const {
    const auto& history = pair_of(column).history;
    const auto *now = history.now.get(), *last = history.settled.get();
    if (!now || now->complete || !now->refusal.isEmpty() || !last || value(row, column)) return {};
    const bool rectangle = kind_of(column) == rectangle_column;
    if ((kind_of(column) != image_column && !rectangle) ||
        (rectangle && last->request.rectangle != now->request.rectangle))
        return {};
    return value_in(last, metrics()[std::size_t(row)].name, rectangle);
}

int MetricsModel::trend(int row, int column) const {
    if (kind_of(column) != image_column && kind_of(column) != rectangle_column) return 0;
    const auto now = value(row, column), before = value(row, column + 1);
    return now && before ? improvement(metrics()[std::size_t(row)], *before, *now) : 0;
}

QString MetricsModel::tooltip(int row, int column) const {
    const auto& metric = metrics()[std::size_t(row)];
    QString text = QStringLiteral("<b>%1</b><br>%2").arg(q(metric.label), q(metric.doc));
    if (metric.best != Best::none)
        text += QStringLiteral("<br>") + (metric.best == Best::highest     ? tr("More is better.")
                                          : metric.best == Best::near_zero ? tr("Nearer to 0 is better.")
                                                                           : tr("Less is better."));
    if (const auto exact = value(row, column); exact && column != name_column)
        text += QStringLiteral("<br>%1 %2").arg(QString::number(*exact, 'g', 9), q(metric.unit));
    if (const int way = trend(row, column)) {
        const auto before = metric_text(metric, *value(row, column + 1));
        text +=
            QStringLiteral("<br>") + (way > 0 ? tr("Better than before the last change (%1).").arg(before)
                                              : tr("Worse than before the last change (%1).").arg(before));
    }
    return text;
}

QVariant MetricsModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || index.row() >= rowCount()) return {};
    const auto& metric = metrics()[std::size_t(index.row())];
    const int column = index.column(), kind = kind_of(column);
    const bool before = kind == image_before || kind == rectangle_before;
    const auto& pair = pair_of(column);
    const auto* now = pair.history.now.get();
    // Of one pair the panel says it.
    const bool is_refused = pairs_.size() > 1 && column != name_column && !pair.refusal.isEmpty();
    switch (role) {
        case Qt::DisplayRole: {
            if (column == name_column) return q(metric.label);
            const auto number = value(index.row(), column);
            const bool coming = now && !now->complete && now->refusal.isEmpty();
            if (const auto last = last_value(index.row(), column)) return metric_text(metric, *last);
            if (!number && coming && !before && (kind == image_column || has_rectangle()))
                return QStringLiteral("…");
            if (!number && is_refused) return QStringLiteral("–");
            if (!number) return {};
            const QString mark = trend(index.row(), column) == 0             ? QString()
                                 : *number > *value(index.row(), column + 1) ? QStringLiteral("▲ ")
                                                                             : QStringLiteral("▼ ");
            return mark + metric_text(metric, *number);
        }
        case Qt::TextAlignmentRole:
            return int((column == name_column ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
        case Qt::ForegroundRole:
            if (before || last_value(index.row(), column))
                return QGuiApplication::palette().color(QPalette::Disabled, QPalette::Text);
            if (const int way = trend(index.row(), column)) return way > 0 ? better_colour : worse_colour;
            return {};
        case Qt::ToolTipRole:
            return is_refused ? pair.refusal : tooltip(index.row(), column);
        default:
            return {};
    }
}

QVariant MetricsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || section >= columnCount()) return {};
    if (role == Qt::TextAlignmentRole)
        return int((section == name_column ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    const auto& pair = pair_of(section);
    const bool is_of_several = section > 0 && pairs_.size() > 1;
    const QString names[] = {tr("Metric"), tr("Image"), tr("before"), tr("Rectangle"), tr("before")};
    const QString tips[] = {
        tr("How the difference of A and B is measured; B is the reference"), tr("All compared pixels"),
        tr("Before the last change of a parameter, the scene or the camera"),
        tr("Compared pixels within the rectangle"), tr("Before the last change, in the same rectangle")};
    const auto kind = std::size_t(kind_of(section));
    if (role == Qt::DisplayRole)
        return !is_of_several         ? names[kind]
               : kind == image_column ? pair.name
                                      : pair.name + QStringLiteral(", ") + names[kind].toLower();
    if (role == Qt::ToolTipRole && is_of_several)
        return QStringList{pair.doc, pair.refusal, tips[kind]}.join(QLatin1Char('\n')).trimmed();
    if (role == Qt::ToolTipRole) return tips[kind];
    return {};
}

}  // namespace ir::widgets
