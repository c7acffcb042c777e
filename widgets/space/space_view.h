#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>

#include "widgets/image/image_view.h"
#include "widgets/space/space_overlay.h"
#include "widgets/space/space_scene.h"

namespace ir::widgets {

class PicturePacer;
class SpaceTools;

/// A picture of buffers in space with a camera that a hand can move. It draws nothing itself: it asks for
/// pictures and shows those that arrive, each until the next one is there. Left drag orbits, Shift-drag (or
/// right, or middle) slides, Ctrl-drag looks around, the wheel goes towards the point under the cursor,
/// W A S D Q E fly, F or a double click frames what is shown, Home is the experiment's camera.
class SpaceView : public QWidget {
    Q_OBJECT
  public:
    explicit SpaceView(QWidget* parent = nullptr, ImageView::Surface surface = ImageView::Surface::best);

    /// What is wanted. Asks for a picture where it differs.
    void set_scene(const SpaceScene& scene);
    void set_layers(const std::vector<SpaceLayer>& layers);
    const SpaceScene& scene() const { return scene_; }
    /// Asks for a picture of the same scene: the buffers have new contents.
    void refresh();

    /// The newest picture; stays until another comes.
    void set_picture(SpacePicture picture);
    /// Why there is no newer picture; the old one stays under it.
    void set_note(const QString& note);
    /// Whether newer buffers than the drawn ones are being rendered; the picture says so.
    void set_stale(bool stale);
    bool is_stale() const { return overlay_.stale; }
    /// Drops the picture (another experiment) and says why.
    void clear(const QString& note);
    const QString& note() const { return overlay_.note; }

    /// In world space, over the pictures.
    void set_marks(SpaceMarks marks);
    const SpaceMarks& marks() const { return overlay_.marks; }
    /// Extent of the scene: framing and the speed of flying.
    void set_bounds(const SpaceBox& bounds);
    /// For the text under the cursor: what a click on an element chooses.
    void set_selectors(const std::vector<SpaceSelector>& selectors);
    /// Values of the element under the cursor, shown beside it; empty: none.
    void set_hover_values(const QString& values);

    const SpacePicture& picture() const { return picture_; }
    bool is_free() const { return scene_.camera.has_value(); }
    /// Camera in force: the free one, else the one that the last picture was drawn with.
    CameraPose pose() const;
    /// Where pictures are shown, in coordinates of this widget.
    QRect picture_area() const;
    /// Size that pictures should have, device pixels.
    QSize wanted_size() const;
    /// What is drawn at a point of picture_area(), or up to three logical pixels from it.
    SpaceElement element_at(QPointF position) const;
    /// What is seen, in device pixels; with tripod, scale, legend and notes on request.
    QImage snapshot(bool overlays) const;

  public slots:
    void use_experiment_camera();
    /// Goes on from where the picture was drawn from.
    void use_free_camera();
    void frame_all();

  signals:
    /// At most one is under way: the next follows when its picture (or note) came, or after 200 ms. Sizes of
    /// points and lines are in pixels of the picture here. Oversampling is more than 1 for a picture that has
    /// stood still for a while.
    void view_wanted(const ir::widgets::SpaceScene& scene, QSize device_px, int oversampling);
    /// A person changed camera, scene or centres (a gesture counts once, at its end).
    void scene_changed(const ir::widgets::SpaceScene& scene);
    void picture_shown(const std::vector<ir::widgets::LayerInfo>& layers);
    /// Layer of the scene, -1 and -1 for the background.
    void element_clicked(int layer, qint64 element);
    void element_hovered(int layer, qint64 element);

  protected:
    bool event(QEvent* event) override;
    void resizeEvent(QResizeEvent*) override;
    void showEvent(QShowEvent*) override;
    void hideEvent(QHideEvent*) override;
    void mousePressEvent(QMouseEvent*) override;
    void mouseMoveEvent(QMouseEvent*) override;
    void mouseReleaseEvent(QMouseEvent*) override;
    void mouseDoubleClickEvent(QMouseEvent*) override;
    void wheelEvent(QWheelEvent*) override;
    void keyPressEvent(QKeyEvent*) override;
    void keyReleaseEvent(QKeyEvent*) override;
    void leaveEvent(QEvent*) override;
    void focusOutEvent(QFocusEvent*) override;
    void changeEvent(QEvent*) override;

  private:
    enum class Drag { none, press, camera };
    bool shows_own_space() const;
    void scene_updated();
    void want_picture();
    void refine_later();
    void send_request();
    void update_overlay();
    void set_busy(bool busy);
    void update_hover();
    void update_hover_text();
    CameraController::Drag drag_for(const QMouseEvent& event) const;
    bool can_move() const;
    /// The hand on the camera in force.
    CameraController& hand();
    void move_camera(const CameraPose& pose);
    void finish_gesture();

    SpaceScene scene_, sent_;
    SpacePicture picture_;
    std::vector<int> indices_;  ///< by layer of the picture: layer of the scene, -1 gone
    OverlayState overlay_;
    ImageView* image_;
    QWidget* overlay_widget_;
    SpaceTools* tools_;
    PicturePacer* pacer_;
    int divisor_ = 1;         ///< of the size of the last request: moving pictures may be coarser
    int oversampling_ = 1;    ///< of the last request
    bool refine_ = false;     ///< the next request is for the same picture with smooth edges
    int moving_divisor_ = 1;  ///< from how long pictures take
    std::optional<CameraPose> experiment_pose_;
    CameraPose sphere_pose_;
    SpaceBox bounds_;
    std::vector<SpaceSelector> selectors_;
    SpaceElement hovered_;
    QString hover_values_;
    Drag drag_ = Drag::none;
    QPointF last_position_, press_position_;
    bool cursor_inside_ = false;
    CameraController hand_;
    QTimer refine_timer_{this};
};

}  // namespace ir::widgets
