#include "widgets/space/layers_model.h"

#include <QIODevice>
#include <QMimeData>
#include <algorithm>

#include "widgets/space/space_overlay.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

const QString row_mime = QStringLiteral("application/x-interreflect-layer-row");

bool same_rows(const std::vector<SpaceLayer>& a, const std::vector<SpaceLayer>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const SpaceLayer& x, const SpaceLayer& y) { return x.key == y.key; });
}

/// "12.3 k of 2.7 M": short, since the column stands beside the name.
QString column_text(const LayerInfo& info) {
    const QString all = count_text(info.elements);
    if (info.requested.filters.empty() || !info.passing) return all;
    if (info.stride <= 1) return QStringLiteral("%1 of %2").arg(count_text(*info.passing), all);
    const auto about = std::min(info.elements, *info.passing * info.stride);  // the rest was not looked at
    return QStringLiteral("≈ %1 of %2").arg(count_text(about), all);
}

}  // namespace

void LayersModel::set_layers(const std::vector<SpaceLayer>& layers) {
    if (layers == layers_) return;
    const bool same = same_rows(layers, layers_);
    if (!same) beginResetModel();
    layers_ = layers;
    place_infos();
    if (!same) return endResetModel();
    announce_all();
}

void LayersModel::announce_all() {
    if (!layers_.empty()) emit dataChanged(index(0, 0), index(int(layers_.size()) - 1, column_count - 1));
}

void LayersModel::place_infos() {
    info_of_row_.assign(layers_.size(), -1);
    const std::vector<int> rows = scene_indices(infos_, layers_);
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i] >= 0) info_of_row_[std::size_t(rows[i])] = int(i);
}

void LayersModel::set_infos(const std::vector<LayerInfo>& infos) {
    infos_ = infos;
    place_infos();
    announce_all();
}

const LayerInfo* LayersModel::info(int row) const {
    if (!is_row(row) || info_of_row_[std::size_t(row)] < 0) return nullptr;
    return &infos_[std::size_t(info_of_row_[std::size_t(row)])];
}

void LayersModel::make_room_for(int shown) {
    const auto is_sphere = [&](const SpaceLayer& layer) { return layer.kind == OutputKind::sphere_values; };
    const bool sphere = is_sphere(layers_[std::size_t(shown)]);
    for (SpaceLayer& layer : layers_)
        if (is_sphere(layer) != sphere) layer.visible = false;
}

void LayersModel::add_layer(const SpaceLayer& layer) {
    const int row = int(layers_.size());
    beginInsertRows({}, row, row);
    layers_.push_back(layer);
    info_of_row_.push_back(-1);
    endInsertRows();
    if (layer.visible) make_room_for(row);
    place_infos();
    announce_all();
    emit layers_edited();
}

void LayersModel::remove_layer(int row) {
    if (!is_row(row)) return;
    beginRemoveRows({}, row, row);
    layers_.erase(layers_.begin() + row);
    info_of_row_.erase(info_of_row_.begin() + row);
    endRemoveRows();
    emit layers_edited();
}

void LayersModel::move_layer(int from, int to) {
    if (!is_row(from) || !is_row(to) || from == to) return;
    beginMoveRows({}, from, from, {}, to > from ? to + 1 : to);
    const auto move = [&](auto& list) {
        const auto value = list[std::size_t(from)];
        list.erase(list.begin() + from);
        list.insert(list.begin() + to, value);
    };
    move(layers_);
    move(info_of_row_);
    endMoveRows();
    emit layers_edited();
}

void LayersModel::change_layer(int row, const SpaceLayer& layer) {
    if (!is_row(row) || layers_[std::size_t(row)] == layer) return;
    const bool shown = layer.visible && !layers_[std::size_t(row)].visible;
    layers_[std::size_t(row)] = layer;
    if (shown) make_room_for(row);
    place_infos();
    announce_all();
    emit layers_edited();
}

int LayersModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(layers_.size());
}

int LayersModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : int(column_count);
}

QVariant LayersModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid() || !is_row(index.row())) return {};
    const SpaceLayer& layer = layers_[std::size_t(index.row())];
    const LayerInfo* drawn = layer.visible ? info(index.row()) : nullptr;
    const bool noted = drawn && !drawn->note.empty();
    if (role == Qt::ToolTipRole) {
        QStringList lines{QString::fromStdString(layer.key)};
        if (drawn && drawn->elements > 0) lines << amount_text(*drawn);
        if (noted) lines << QString::fromStdString(drawn->note);
        return lines.join(QLatin1Char('\n'));
    }
    if (index.column() == count_column) {
        if (role == Qt::TextAlignmentRole) return int(Qt::AlignRight | Qt::AlignVCenter);
        return role == Qt::DisplayRole && drawn ? QVariant(column_text(*drawn)) : QVariant();
    }
    if (role == Qt::DisplayRole) return QString::fromStdString(layer.label);
    if (role == Qt::CheckStateRole) return int(layer.visible ? Qt::Checked : Qt::Unchecked);
    if (role == Qt::DecorationRole && noted) return icon("warning");
    return {};
}

bool LayersModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!index.isValid() || index.column() != name_column || role != Qt::CheckStateRole) return false;
    SpaceLayer layer = layers_[std::size_t(index.row())];
    layer.visible = value.toInt() == Qt::Checked;
    change_layer(index.row(), layer);
    return true;
}

Qt::ItemFlags LayersModel::flags(const QModelIndex& index) const {
    if (!index.isValid()) return Qt::ItemIsDropEnabled;  // between rows, not upon them
    auto flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled | Qt::ItemNeverHasChildren;
    return index.column() == name_column ? flags | Qt::ItemIsUserCheckable : flags;
}

QVariant LayersModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    return section == name_column    ? QVariant(tr("Layer"))
           : section == count_column ? QVariant(tr("Elements"))
                                     : QVariant();
}

QStringList LayersModel::mimeTypes() const {
    return {row_mime};
}

QMimeData* LayersModel::mimeData(const QModelIndexList& indexes) const {
    auto* data = new QMimeData;
    if (!indexes.isEmpty()) data->setData(row_mime, QByteArray::number(indexes.first().row()));
    return data;
}

bool LayersModel::dropMimeData(const QMimeData* data, Qt::DropAction, int row, int,
                               const QModelIndex& parent) {
    if (!data->hasFormat(row_mime)) return false;
    const int from = data->data(row_mime).toInt();
    int to = row >= 0 ? row : parent.isValid() ? parent.row() : rowCount();
    if (to > from) --to;  // counted without the row that moves
    move_layer(from, std::min(to, rowCount() - 1));
    return false;  // the row has moved already: the view has nothing to remove
}

}  // namespace ir::widgets
