#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QPointF>
#include <QSet>
#include <QTimer>

#include "widgets/image/camera_motion.h"

class QKeyEvent;

namespace ir::widgets {

/// A hand on a camera: drags turn and slide it, W A S D Q E fly (Shift: faster). All that comes until the
/// hand lets go is one gesture.
class CameraController : public QObject {
    Q_OBJECT
  public:
    enum class Drag { orbit, slide, look };

    explicit CameraController(QObject* parent = nullptr);

    const CameraPose& pose() const { return pose_; }
    /// The camera was moved elsewhere. Emits posed() alone.
    void set_pose(const CameraPose& pose);
    void set_fly_speed(double metres_per_second) { fly_speed_ = metres_per_second; }
    bool is_moving() const { return moving_; }

    void begin_drag(Drag drag) { drag_ = drag; }
    /// By logical pixels. Across the view's height the camera turns by half a circle; sliding, what is seen
    /// at the target follows the cursor.
    void drag(QPointF delta, double view_height, double picture_height);
    void move_to(const CameraPose& pose);

    static bool is_fly_key(int key);
    void press_key(const QKeyEvent& event);
    /// Whether the last key was let go of.
    bool release_key(const QKeyEvent& event);
    bool holds_key(int key) const { return keys_.contains(key); }
    /// All keys are up: the keyboard is elsewhere.
    void drop_keys();

    /// The gesture ends unless it goes on soon.
    void settle() { settle_timer_.start(); }
    void finish();

  signals:
    void moved(const ir::widgets::CameraPose& pose);
    /// The pose is another one, whoever changed it.
    void posed();
    /// What came since the last one is one step.
    void finished();

  private:
    void fly();
    CameraPose pose_;
    Drag drag_ = Drag::orbit;
    double fly_speed_ = 1;
    bool moving_ = false;
    QSet<int> keys_;
    QTimer fly_timer_, settle_timer_;
    QElapsedTimer fly_clock_;
};

}  // namespace ir::widgets
