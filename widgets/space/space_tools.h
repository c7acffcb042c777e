#pragma once

#include <QToolBar>

#include "widgets/space/space_scene.h"

namespace ir::widgets {

/// The tools above a picture in space: which camera, framing, what is drawn beside the layers.
class SpaceTools : public QToolBar {
    Q_OBJECT
  public:
    explicit SpaceTools(QWidget* parent = nullptr);
    /// `own_space`: the layers stand in a space of their own [Space::own].
    void show_state(const SpaceScene& scene, bool own_space);

  signals:
    void experiment_camera_wanted();
    void free_camera_wanted();
    void frame_wanted();
    void scene_toggled(bool on);
    void centres_toggled(bool on);

  private:
    QAction *experiment_camera_, *free_camera_, *show_scene_, *show_centres_;
};

}  // namespace ir::widgets
