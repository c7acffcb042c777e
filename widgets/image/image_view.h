#pragma once

#include <QElapsedTimer>
#include <QSet>
#include <QTimer>
#include <QWidget>

#include "widgets/image/camera_motion.h"
#include "widgets/image/canvas.h"
#include "widgets/image/region.h"

namespace ir::widgets {

/// One picture (or two with a divider between them) with zoom, pan, values and the tools that move its
/// camera. Knows nothing of where pictures come from. The wheel always zooms the picture; the middle button
/// or Space and the left one always move it; the tool says what the left button does otherwise.
class ImageView : public QWidget {
    Q_OBJECT
  public:
    enum class Tool { inspect, orbit, fly, rectangle };
    enum class Surface { best, raster };
    Q_ENUM(Tool)

    explicit ImageView(QWidget* parent = nullptr, Surface surface = Surface::best);

    /// Shows a picture without copying it; zoom and place stay. Null: nothing at all.
    void set_picture(std::shared_ptr<const Picture> picture);
    /// Shows B right of the divider; null: the first picture alone. Throws UsageError for another size.
    void set_second(std::shared_ptr<const Picture> picture);
    /// Takes the picture over; zoom and place stay.
    void set_image(Image image, Semantic semantic);
    /// No picture, and the reason in its place.
    void set_note(const QString& note);
    void set_display(const Display& display);
    void set_second_display(const Display& display);
    /// Names in the top corners; the second right of the divider.
    void set_labels(const QString& label, const QString& second = {});
    /// Where the divider is: a fraction of the picture's width, 0 … 1.
    void set_wipe(double fraction);
    void set_legend(bool on);
    /// Marks a pixel that the cursor is on in another view; (-1, -1): none.
    void set_cursor_mark(QPoint pixel);
    void set_picked(QPoint pixel);
    void set_pins(const std::vector<PinMark>& pins);
    /// Marks a rectangle of whole pixels; empty: none. Emits nothing.
    void set_region(const QRect& region);
    /// Takes zoom and place (or being fitted) over from another view of the same picture size. Emits nothing.
    void follow(const ViewTransform& transform);
    void set_stale(bool stale);
    void set_camera(const CameraPose& pose) { pose_ = pose; }
    /// Metres per second of the fly camera.
    void set_fly_speed(double metres_per_second) { fly_speed_ = metres_per_second; }

    const Image& image() const;  ///< empty without a picture
    const std::shared_ptr<const Picture>& picture() const;
    const std::shared_ptr<const Picture>& second() const;
    const Display& display() const { return display_; }
    const Display& second_display() const { return second_display_; }
    Semantic semantic() const;
    double wipe() const { return state_.wipe; }
    bool legend() const { return state_.legend; }
    const QString& label() const { return state_.label; }
    const QString& note() const { return state_.note; }
    const CameraPose& camera() const { return pose_; }
    const ViewTransform& transform() const { return state_.transform; }
    Tool tool() const { return tool_; }
    QPoint picked() const { return state_.picked; }
    const QRect& region() const { return state_.region; }
    const char* surface_kind() const { return canvas_->kind(); }
    /// How often pixels went to the graphics memory (OpenGL) or through the colours (raster) so far.
    int upload_count() const { return canvas_->upload_count(); }

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
    void zoom_in();
    void zoom_out();
    void look_at(QPointF image_px, double zoom);
    void set_pixel_grid(bool on);

  signals:
    /// Pixel under the cursor; (-1, -1) outside the picture.
    void cursor_moved(QPoint pixel);
    void picked_changed(QPoint pixel);
    /// Drawn, moved or resized with the rectangle tool, at each step; empty: cleared.
    void region_changed(QRect region);
    void zoom_changed(double zoom);
    /// A person (or a slot above) zoomed or panned.
    void transform_changed(const ir::widgets::ViewTransform& transform);
    void wipe_moved(double fraction);
    void activated();  ///< got the keyboard
    void camera_moved(const ir::widgets::CameraPose& pose);
    /// The hand let go: what came since the last one is one step.
    void camera_gesture_finished();
    void tool_changed(ir::widgets::ImageView::Tool tool);

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
    void leaveEvent(QEvent*) override;
    void focusInEvent(QFocusEvent*) override;
    void focusOutEvent(QFocusEvent*) override;
    void changeEvent(QEvent*) override;

  private:
    enum class Drag { none, pan, orbit, slide, look, pick, wipe, region };
    Drag drag_for(const QMouseEvent& event) const;
    void drag_camera(QPointF delta);
    void move_camera(const CameraPose& pose);
    void finish_gesture();
    void fly_step();
    void finish_transform();
    bool is_over_divider(QPointF logical) const;
    void move_wipe(double fraction);
    void repaint_all();
    void update_hint();
    void update_cursor_shape();
    QPointF device(QPointF logical) const { return logical * devicePixelRatioF(); }
    QPoint pixel_at(QPointF logical) const;

    // image_view_region.cpp
    bool edits_region() const;
    void change_region(const QRect& region);
    RegionGrip region_grip_at(QPointF logical) const;
    void start_region(QPointF logical);
    void drag_region(QPointF logical, Qt::KeyboardModifiers modifiers);
    bool takes_region_key(const QKeyEvent& event) const;
    void press_region_key(const QKeyEvent& event);
    static Qt::CursorShape region_cursor(const RegionGrip& grip);

    CanvasState state_;
    PictureCache cache_;
    Display display_, second_display_;
    Canvas* canvas_;
    QWidget* overlay_;
    Tool tool_ = Tool::inspect;
    CameraPose pose_;
    Drag drag_ = Drag::none;
    QPointF last_position_, press_position_;
    RegionGrip region_grip_;  ///< under the cursor; of the drag while there is one
    QRect region_before_;     ///< when the drag began
    QPointF region_from_;     ///< where it began, pixels of the picture
    bool space_ = false, gesture_ = false, over_divider_ = false, stale_ = false;
    double fly_speed_ = 1;
    QSet<int> keys_;
    QTimer fly_timer_, settle_timer_;
    QElapsedTimer fly_clock_;
};

}  // namespace ir::widgets
