#pragma once

#include <QWidget>
#include <map>
#include <vector>

#include "widgets/space/space_scene.h"

class QLabel;
class QScrollArea;
class QTreeView;
class QVBoxLayout;

namespace ir::widgets {

class LayerDetails;
class LayersModel;
class SearchButton;
class SelectorRow;

/// What a 3D view draws and how: items of selectors ("map 17 of 512"), layers with a tick each, and for the
/// chosen layer its colours, size and filters.
class LayerPanel : public QWidget {
    Q_OBJECT
  public:
    explicit LayerPanel(QWidget* parent = nullptr);

    /// What could be added.
    void set_available(const std::vector<AvailableBuffer>& buffers);
    /// What is drawn; emits nothing.
    void set_layers(const std::vector<SpaceLayer>& layers);
    const std::vector<SpaceLayer>& layers() const;
    /// What became of the visible layers in the last picture.
    void set_layer_infos(const std::vector<LayerInfo>& infos);
    void set_selectors(const std::vector<SpaceSelector>& selectors);

    int current_layer() const;
    void set_current_layer(int row);
    LayersModel& model() { return *model_; }
    QTreeView* view() { return view_; }
    LayerDetails& details() { return *details_; }

  signals:
    /// A person changed something about the layers.
    void layers_chosen(const std::vector<ir::widgets::SpaceLayer>& layers);
    /// An item from 0 on, or SpaceSelector::all.
    void item_chosen(const QString& selector, int item);

  private:
    void make_list();
    void list_available();
    void show_current();
    void remember_ranges(const std::vector<LayerInfo>& infos);
    const std::vector<Field>& fields_of(const std::string& key) const;
    QAction* add_action(const char* name, const QString& text, const QKeySequence& key);
    void update_actions();

    LayersModel* model_;
    QTreeView* view_;
    QVBoxLayout* selectors_;
    std::vector<SelectorRow*> selector_rows_;
    SearchButton* add_;
    QAction *remove_, *up_, *down_;
    LayerDetails* details_ = nullptr;
    QLabel* nothing_ = nullptr;
    QScrollArea* scroll_ = nullptr;
    std::vector<AvailableBuffer> available_;
    std::map<std::string, std::vector<Field>> fields_;
    std::map<std::string, std::vector<std::optional<FieldRange>>> ranges_;
};

}  // namespace ir::widgets
