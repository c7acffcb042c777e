#include "widgets/plot/plot_table_model.h"

#include <QIcon>
#include <QPainter>
#include <QPixmap>

#include "widgets/models/heading.h"
#include "widgets/plot/plot_painter.h"

namespace ir::widgets {
namespace {

QIcon mark_icon(int series, const std::optional<Tint>& own) {
    constexpr int size = 14, sharpness = 2;
    QPixmap pixmap(size * sharpness, size * sharpness);
    pixmap.setDevicePixelRatio(sharpness);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    PlotPainter canvas({}, &painter);
    constexpr double edge = 2;
    if (own)
        canvas.box({edge, edge, size - edge, size - edge}, {plot_colour(*own), "own"});
    else
        draw_plot_mark(canvas, {size / 2.0, size / 2.0}, series, mark_radius(0), window_style());
    return pixmap;
}

}  // namespace

void PlotTableModel::set_data(const PlotData& data) {
    std::vector<Row> rows;
    for (const auto& [point, series] : data.in_reading_order()) rows.push_back({*point, series});
    const auto same_shape = [&] {
        if (headings_ != data.headings || rows_.size() != rows.size()) return false;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i].point.id != rows_[i].point.id) return false;
        return true;
    };
    if (same_shape()) {
        if (rows_ == rows) return;
        rows_ = std::move(rows);
        emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
        return;
    }
    beginResetModel();
    headings_ = data.headings;
    rows_ = std::move(rows);
    endResetModel();
}

QModelIndex PlotTableModel::index_of(const QString& id) const {
    const auto wanted = id.toStdString();
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].point.id == wanted) return index(int(i), 0);
    return {};
}

int PlotTableModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(rows_.size());
}

int PlotTableModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(headings_.size());
}

QVariant PlotTableModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const auto& row = rows_[std::size_t(index.row())];
    if (role == id_role) return QString::fromStdString(row.point.id);
    if (role == Qt::ToolTipRole) return QString::fromStdString(row.point.label);
    if (std::size_t(index.column()) >= row.point.cells.size()) return {};
    const auto& cell = row.point.cells[std::size_t(index.column())];
    const bool is_number = cell.number.has_value();
    switch (role) {
        case Qt::DisplayRole:
            return QString::fromStdString(cell.text);
        case sort_role:
            return is_number ? QVariant(*cell.number) : QVariant(QString::fromStdString(cell.text));
        case Qt::DecorationRole:
            return index.column() == 0 ? QVariant(mark_icon(row.series, row.point.colour)) : QVariant();
        case Qt::TextAlignmentRole:
            return int((is_number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
        default:
            return {};
    }
}

QVariant PlotTableModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || section < 0 || std::size_t(section) >= headings_.size()) return {};
    if (role == Qt::TextAlignmentRole) return heading_alignment(*this, section);
    const auto& heading = headings_[std::size_t(section)];
    return role == Qt::DisplayRole ? QVariant(QString::fromStdString(heading)) : QVariant();
}

}  // namespace ir::widgets
