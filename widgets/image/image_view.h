#pragma once

#include <QElapsedTimer>
#include <QSet>
#include <QTimer>
#include <QWidget>

#include "widgets/image/camera_motion.h"
#include "widgets/image/canvas.h"

namespace ir::widgets {

/// One picture with zoom, pan, values and the tools that move its camera. Knows nothing of where pictures
/// come from. The wheel always zooms the picture; the middle button or Space and the left one always move it;
/// the tool says what the left button does otherwise.
class ImageView : public QWidget {
    Q_OBJECT
  public:
    enum class Tool { inspect, orbit, fly };
    enum class Surface { best, raster };
    Q_ENUM(Tool)

    explicit ImageView(QWidget* parent = nullptr, Surface surface = Surface::best);

    /// Takes the picture over; zoom and place stay.
    void set_image(Image image, Semantic semantic);
    /// No picture, and the reason in its place.
    void set_note(const QString& note);
    void set_display(const Display& display);
    void set_stale(bool stale);
    void set_camera(const CameraPose& pose) { pose_ = pose; }
    /// Metres per second of the fly camera.
    void set_fly_speed(double metres_per_second) { fly_speed_ = metres_per_second; }

    const Image& image() const { return state_.image; }
    const Display& display() const { return state_.display; }
    Semantic semantic() const { return state_.semantic; }
    const CameraPose& camera() const { return pose_; }
    const ViewTransform& transform() const { return state_.transform; }
    Tool tool() const { return tool_; }
    QPoint picked() const { return state_.picked; }
    const char* surface_kind() const { return canvas_->kind(); }

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
    void zoom_changed(double zoom);
    void camera_moved(const ir::widgets::CameraPose& pose);
    /// The hand let go: what came since the last one is one step.
    void camera_gesture_finished();
    void tool_changed(ir::widgets::ImageView::Tool tool);

  protected:
    void resizeEvent(QResizeEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void keyReleaseEvent(QKeyEvent*) override;
    void leaveEvent(QEvent*) override;
    void focusOutEvent(QFocusEvent*) override;
    void changeEvent(QEvent*) override;

  private:
    enum class Drag { none, pan, orbit, slide, look, pick };
    Drag drag_for(const QMouseEvent& event) const;
    void drag_camera(QPointF delta);
    void move_camera(const CameraPose& pose);
    void finish_gesture();
    void fly_step();
    void transform_changed();
    void repaint_all();
    void update_hint();
    void update_cursor_shape();
    QPointF device(QPointF logical) const { return logical * devicePixelRatioF(); }
    QPoint pixel_at(QPointF logical) const;

    CanvasState state_;
    Canvas* canvas_;
    QWidget* overlay_;
    Tool tool_ = Tool::inspect;
    CameraPose pose_;
    Drag drag_ = Drag::none;
    QPointF last_position_, press_position_;
    bool space_ = false, gesture_ = false;
    double fly_speed_ = 1;
    QSet<int> keys_;
    QTimer fly_timer_, settle_timer_;
    QElapsedTimer fly_clock_;
};

}  // namespace ir::widgets
