#pragma once

#include <QObject>
#include <array>
#include <memory>
#include <optional>

#include "app/gui/view_model.h"

namespace ir::gui {

/// Draws buffers that stand in space: asks the renderer for pictures of them, and answers what is pointed at.
class SpacePresenter : public QObject {
    Q_OBJECT
  public:
    SpacePresenter(LivePictures& live, Renderer& renderer, ViewModel& views);
    /// The pane in which a view shows space.
    void add(int view, widgets::SpacePane& space);
    void update(int view);
    bool is_drawing(int view) const { return drawings_[std::size_t(view)].is_under_way(); }
    void clear() { drawings_ = {}; }

  private:
    void request(int view, const widgets::SpaceScene& scene, QSize device_px, int oversampling);
    void on_picture(std::shared_ptr<const engine::SceneViewResult> result);
    std::optional<widgets::BufferReader> values_of(int view, int layer) const;
    QString hover_text(int view, int layer, qint64 element) const;
    void choose_items(int view, int layer, qint64 element);

    /// 3D pictures of a view: what the newest was drawn from, whose they are, and which requests of that
    /// owner were sent and answered.
    struct Drawing {
        std::weak_ptr<const engine::LiveResult> result;
        std::string owner;
        std::uint64_t first_serial = 0, newest_serial = 0, answered_serial = 0;
        bool is_under_way() const { return answered_serial < newest_serial; }
    };
    static constexpr std::size_t max_views = widgets::ViewArea::max_views;
    LivePictures& live_;
    Renderer& renderer_;
    ViewModel& views_;
    std::array<widgets::SpacePane*, max_views> spaces_{};
    std::array<Drawing, max_views> drawings_;
};

}  // namespace ir::gui
