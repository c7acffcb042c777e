#pragma once

#include <QObject>
#include <optional>
#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/scene/scene.h"
#include "widgets/image/camera_motion.h"

namespace ir::gui {

class Session;

/// A camera of its own with the pose, named `name`, or with a number behind it where that is taken.
projects::Camera new_view(const projects::Project& project, const widgets::CameraPose& pose,
                          const std::string& name);

/// The camera of the experiment that is worked on. Moves are shown at once and become one edit when the
/// gesture ends.
class ExperimentCamera : public QObject {
    Q_OBJECT
  public:
    explicit ExperimentCamera(Session& session) : session_(session) {}
    /// The scene's cameras in world space, for experiments that use one of them.
    void set_scene_cameras(std::vector<scene::Camera> cameras) { scene_cameras_ = std::move(cameras); }
    /// Where the timeline stands, seconds; absent: at the experiment's own time.
    void set_shown_time(std::optional<double> time) { shown_time_ = time; }
    std::optional<widgets::CameraPose> pose() const;
    /// While a gesture lasts: the pose of an experiment that it moves.
    std::optional<widgets::CameraPose> moved_pose(const std::string& experiment) const;

    /// Moves an experiment, and others together with it.
    void move(const std::string& experiment, const widgets::CameraPose& pose,
              const std::vector<std::string>& others = {});
    void finish_move();
    void forget_move();
    /// Adds a camera with the present pose to the document.
    void bookmark();

  signals:
    void moved();

  private:
    Session& session_;
    std::vector<scene::Camera> scene_cameras_;
    std::optional<widgets::CameraPose> moved_pose_;
    std::vector<std::string> moved_;  ///< experiments that the gesture moves
    std::optional<double> shown_time_;
};

}  // namespace ir::gui
