#pragma once

#include "app/gui/scene_shelf.h"
#include "app/gui/session.h"
#include "widgets/panels/rows_panel.h"

namespace ir::gui {

/// What the scene that is worked on consists of. A camera that is activated is wanted.
class SceneDock : public widgets::RowsPanel {
    Q_OBJECT
  public:
    SceneDock(Session& session, SceneShelf& scenes);

  signals:
    void camera_chosen(const QString& name);

  private:
    void update_rows();

    Session& session_;
    SceneShelf& scenes_;
};

}  // namespace ir::gui
