#include "widgets/models/messages_model.h"

#include <QGuiApplication>
#include <QPalette>
#include <algorithm>

#include "widgets/style/icons.h"

namespace ir::widgets {

QString severity_name(Severity severity) {
    switch (severity) {
        case Severity::error:
            return MessagesModel::tr("Error");
        case Severity::warning:
            return MessagesModel::tr("Warning");
        default:
            return MessagesModel::tr("Note");
    }
}

void MessagesModel::add(const Message& message) {
    const auto same = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
        return line.message.severity == message.severity && line.message.source == message.source &&
               line.message.text == message.text && line.message.place == message.place;
    });
    if (same != lines_.end()) {
        ++same->times;
        same->time = QDateTime::currentDateTime();
        const int row = int(same - lines_.begin());
        emit dataChanged(index(row, 0), index(row, column_count - 1));
        emit counts_changed();
        return;
    }
    if (lines_.size() >= limit) {
        beginRemoveRows({}, 0, 0);
        lines_.erase(lines_.begin());
        endRemoveRows();
    }
    const int row = int(lines_.size());
    beginInsertRows({}, row, row);
    lines_.push_back({message, QDateTime::currentDateTime()});
    endInsertRows();
    emit counts_changed();
}

void MessagesModel::clear() {
    beginResetModel();
    lines_.clear();
    endResetModel();
    emit counts_changed();
}

int MessagesModel::count(Severity severity) const {
    return int(std::count_if(lines_.begin(), lines_.end(),
                             [&](const Line& line) { return line.message.severity == severity; }));
}

std::vector<MessagesModel::SourceCount> MessagesModel::sources() const {
    std::vector<SourceCount> result;
    for (const Line& line : lines_) {
        const auto same = [&](const SourceCount& count) { return count.source == line.message.source; };
        auto found = std::find_if(result.begin(), result.end(), same);
        if (found == result.end()) found = result.insert(result.end(), {line.message.source});
        found->count += line.times;
        found->worst = std::max(found->worst, line.message.severity);
    }
    return result;
}

QString MessagesModel::text(const QModelIndexList& rows) const {
    std::vector<int> numbers;
    for (const auto& row : rows) numbers.push_back(row.row());
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    QStringList lines;
    for (int row : numbers) {
        const Line& line = lines_.at(std::size_t(row));
        QString text =
            QStringLiteral("%1 %2: %3: %4")
                .arg(line.time.toString(Qt::ISODate), severity_name(line.message.severity),
                     QString::fromStdString(line.message.source), QString::fromStdString(line.message.text));
        if (!line.message.place.empty())
            text += QStringLiteral(" [%1]").arg(QString::fromStdString(line.message.place));
        lines << text;
    }
    return lines.join(QLatin1Char('\n'));
}

int MessagesModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(lines_.size());
}

int MessagesModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : column_count;
}

QVariant MessagesModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Line& line = lines_.at(std::size_t(index.row()));
    const QString text = QString::fromStdString(line.message.text);
    if (role == severity_role) return int(line.message.severity);
    const QString place = QString::fromStdString(line.message.place);
    if (role == place_role) return place;
    if (role == source_role) return QString::fromStdString(line.message.source);
    if (role == Qt::ToolTipRole)
        return place.isEmpty() ? text : tr("%1\n\nDouble click: go to %2").arg(text, place);
    if (role == Qt::ForegroundRole && index.column() == source_column && !place.isEmpty())
        return QGuiApplication::palette().color(QPalette::Link);
    if (role == Qt::DecorationRole && index.column() == severity_column)
        return icon(line.message.severity == Severity::error     ? "error"
                    : line.message.severity == Severity::warning ? "warning"
                                                                 : "note");
    if (role != Qt::DisplayRole) return {};
    switch (index.column()) {
        case severity_column:
            return severity_name(line.message.severity);
        case time_column:
            return line.time.toString(QStringLiteral("HH:mm:ss"));
        case source_column:
            return QString::fromStdString(line.message.source);
        default:
            return line.times > 1 ? tr("%1  (%2 times)").arg(text).arg(line.times) : text;
    }
}

QVariant MessagesModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole || section >= column_count) return {};
    return QStringList{tr("Severity"), tr("Time"), tr("Source"), tr("Message")}.at(section);
}

void MessagesFilter::set_shown(Severity severity, bool shown) {
    shown_[int(severity)] = shown;
    invalidateFilter();
}

void MessagesFilter::set_text(const QString& text) {
    text_ = text;
    invalidateFilter();
}

void MessagesFilter::set_source(const QString& source) {
    source_ = source;
    invalidateFilter();
}

bool MessagesFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
    const QModelIndex line = sourceModel()->index(row, MessagesModel::text_column, parent);
    if (!shown_[line.data(MessagesModel::severity_role).toInt()]) return false;
    if (!source_.isEmpty() && line.data(MessagesModel::source_role).toString() != source_) return false;
    return text_.isEmpty() || line.data().toString().contains(text_, Qt::CaseInsensitive);
}

}  // namespace ir::widgets
