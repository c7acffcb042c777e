#pragma once

#include <QWidget>
#include <utility>

#include "widgets/image/camera_controller.h"
#include "widgets/image/canvas.h"
#include "widgets/image/light_tool.h"
#include "widgets/image/line_tool.h"
#include "widgets/image/region_tool.h"

namespace ir::widgets {

/// One picture (or two with a divider between them) with zoom, pan, values and the tools that move its
/// camera. Knows nothing of where pictures come from. The wheel always zooms the picture; the middle button
/// or Space and the left one always move it; the tool says what the left button does otherwise.
class ImageView : public QWidget {
    Q_OBJECT
  public:
    enum class Tool { inspect, orbit, fly, rectangle, line };
    enum class Surface { best, raster };
    Q_ENUM(Tool)

    explicit ImageView(QWidget* parent = nullptr, Surface surface = Surface::best);

    /// Shows a picture without copying it; zoom and place stay. One without an image says why in its place;
    /// null: nothing at all.
    void set_picture(std::shared_ptr<const Picture> picture);
    /// Shows B right of the divider, or in a lens about the cursor; null: the first picture alone. Throws
    /// UsageError for another size.
    void set_second(std::shared_ptr<const Picture> picture, const Display& display = {},
                    bool has_lens = false);
    void set_display(const Display& display);
    /// Names in the top corners; the second right of the divider.
    void set_labels(const QString& label, const QString& second = {});
    /// Where the divider is: a fraction of the picture's width, 0 … 1.
    void set_wipe(double fraction);
    void set_legend(bool on, bool has_room = false);  ///< room that stays free without one
    /// As in set_mark(&Marks::picked, pixel). Emits nothing.
    template <typename Mark>
    void set_mark(Mark Marks::*mark, const std::type_identity_t<Mark>& value) {
        if (std::exchange(state_.marks.*mark, value) == value) return;
        state_.hint = hint();
        overlay_->update();
    }
    /// Takes zoom and place (or being fitted) over from another view of the same picture size. Emits nothing.
    void follow(const ViewTransform& transform);
    void set_stale(bool stale);
    /// A light of the picture's scene, with handles; none: there are none.
    void set_light(std::optional<PlacedLight> light);

    const Image& image() const;  ///< empty without a picture
    const std::shared_ptr<const Picture>& picture() const { return state_.pictures[0].picture; }
    const Display& display() const { return display_; }
    const ViewTransform& transform() const { return state_.transform; }
    /// All that is shown.
    const CanvasState& state() const { return state_; }
    const Canvas& canvas() const { return *canvas_; }
    Tool tool() const { return tool_; }
    CameraController& camera() { return camera_; }

    enum class SnapshotScale {
        as_shown,       ///< what is seen, in device pixels
        picture_pixels  ///< the whole picture, a pixel each; a legend stands beside it
    };
    /// What is shown; overlays are labels, divider, grid, numbers and the picked pixel. The same on every
    /// surface.
    QImage snapshot(bool overlays, bool legend, SnapshotScale scale = SnapshotScale::as_shown) const;

  public slots:
    void set_tool(ir::widgets::ImageView::Tool tool);
    void fit();
    void actual_pixels();
    /// In (positive) or out.
    void zoom(int steps);
    void look_at(QPointF image_px, double zoom);
    void set_pixel_grid(bool on);

  signals:
    /// Pixel under the cursor; (-1, -1) outside the picture.
    void cursor_moved(QPoint pixel);
    void picked_changed(QPoint pixel);
    /// A pick of a pixel of the picture with Shift.
    void explain_wanted(QPoint pixel);
    /// Drawn, moved or resized with the rectangle tool, at each step; empty: cleared.
    void region_changed(QRect region);
    void line_changed(QLine line);  ///< likewise with the line's tool; null: cleared
    void shape_drawn();             ///< the hand let go of one of them
    void zoom_changed(double zoom);
    /// A person (or a slot above) zoomed or panned.
    void transform_changed(const ir::widgets::ViewTransform& transform);
    void wipe_moved(double fraction);
    void activated();  ///< got the keyboard
    /// A right click, which also picks the pixel, or the menu key.
    void menu_wanted(QPoint global_position);
    void camera_moved(const ir::widgets::CameraPose& pose);
    /// The hand let go: what came since the last one is one step.
    void camera_gesture_finished();
    void tool_changed(ir::widgets::ImageView::Tool tool);
    // As in LightTool.
    void light_moved(const glm::dvec3& position);
    void light_turned(const glm::dvec3& direction);
    void light_gesture_finished(bool kept);

  protected:
    bool event(QEvent*) override;
    void resizeEvent(QResizeEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void mouseDoubleClickEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void keyReleaseEvent(QKeyEvent*) override;
    void contextMenuEvent(QContextMenuEvent*) override;
    void leaveEvent(QEvent*) override;
    void focusInEvent(QFocusEvent*) override;
    void focusOutEvent(QFocusEvent*) override;
    void changeEvent(QEvent*) override;

  private:
    enum class Drag { none, pan, camera, pick, wipe, shape, light };
    ShapeTool* shape_tool();  ///< null: this tool draws none
    Drag drag_for(const QMouseEvent& event);
    bool moves_camera() const { return tool_ == Tool::orbit || tool_ == Tool::fly; }
    void finish_transform();
    void pick(QPointF logical);
    bool takes_light_key(const QKeyEvent& event) const;
    bool is_click(QPointF logical) const;
    bool is_over_divider(QPointF logical) const {
        return state_.is_over_divider(device(logical), devicePixelRatioF());
    }
    void move_wipe(double fraction);
    void repaint_all();
    QString hint() const;
    void update_hint();
    void update_cursor_shape();
    QPointF device(QPointF logical) const { return logical * devicePixelRatioF(); }
    QPoint pixel_at(QPointF logical) const;

    CanvasState state_;
    PictureCache cache_;
    Display display_;
    Canvas* canvas_;
    QWidget* overlay_;
    CameraController camera_;
    RegionTool region_tool_;
    LineTool line_tool_;
    LightTool light_tool_;
    Tool tool_ = Tool::inspect;
    Drag drag_ = Drag::none;
    QPointF last_position_, press_position_;
    bool space_ = false, over_divider_ = false, stale_ = false;
};

}  // namespace ir::widgets
