#pragma once

#include <QWidget>

#include "widgets/space/layer_panel.h"
#include "widgets/space/space_view.h"

namespace ir::widgets {

/// A 3D view with its layer panel beside it, wired to each other: what a dock of the window holds. A click on
/// an element marks it.
class SpacePane : public QWidget {
    Q_OBJECT
  public:
    explicit SpacePane(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);

    SpaceView& view() { return *view_; }
    LayerPanel& panel() { return *panel_; }
    void set_scene(const SpaceScene& scene);
    /// What can be drawn. While nobody chose layers, the first points are shown, or the first buffer.
    void set_available(const std::vector<AvailableBuffer>& buffers);
    void set_selectors(const std::vector<SpaceSelector>& selectors);
    /// Marks an element of all layers that show a buffer; -1: none.
    void select_element(const std::string& key, std::int64_t element);

    /// Whether the panel stands beside the view. Until somebody says so, it does where there is room.
    void set_panel_shown(bool shown);
    bool is_panel_shown() const { return !panel_scroll_->isHidden(); }

  signals:
    void panel_shown_changed(bool shown);
    /// The wanted scene changed by hand: layers, camera, ticks.
    void scene_changed(const ir::widgets::SpaceScene& scene);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void show_panel(bool shown);
    void mark(int layer, std::int64_t element);
    SpaceView* view_;
    LayerPanel* panel_;
    QWidget* panel_scroll_;
    bool chosen_ = false;         ///< somebody decided about the layers
    bool panel_decided_ = false;  ///< somebody decided about the panel
};

}  // namespace ir::widgets
