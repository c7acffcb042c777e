#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "widgets/space/space_scene.h"

namespace ir::widgets {

/// The layers of a 3D view: a tick and a label, and how many elements there are. The last is drawn over the
/// others where they meet. A sphere of directions stands alone: showing one hides the other kinds.
class LayersModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { name_column, count_column, column_count };
    using QAbstractTableModel::QAbstractTableModel;

    /// Shows what somebody else decided; emits no layers_edited. Rows of the same keys stay the same rows.
    void set_layers(const std::vector<SpaceLayer>& layers);
    const std::vector<SpaceLayer>& layers() const { return layers_; }
    /// What became of the visible layers.
    void set_infos(const std::vector<LayerInfo>& infos);
    /// Of a row; null: not drawn yet.
    const LayerInfo* info(int row) const;

    void add_layer(const SpaceLayer& layer);
    void remove_layer(int row);
    /// Moves a row so that it stands at `to` afterwards.
    void move_layer(int from, int to);
    void change_layer(int row, const SpaceLayer& layer);

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::DropActions supportedDropActions() const override { return Qt::MoveAction; }
    QStringList mimeTypes() const override;
    QMimeData* mimeData(const QModelIndexList& indexes) const override;
    bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                      const QModelIndex& parent) override;

  signals:
    /// A person changed the layers.
    void layers_edited();

  private:
    void make_room_for(int shown);
    void place_infos();
    void announce_all();
    bool is_row(int row) const { return row >= 0 && row < int(layers_.size()); }

    std::vector<SpaceLayer> layers_;
    std::vector<LayerInfo> infos_;
    std::vector<int> info_of_row_;  ///< -1: none
};

}  // namespace ir::widgets
