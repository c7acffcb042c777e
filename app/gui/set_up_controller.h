#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/workspace.h"

namespace ir::gui {

/// Sets a question up in one click, at the place of the experiment that is worked on.
class SetUpController : public QObject {
    Q_OBJECT
  public:
    SetUpController(Session& session, LivePictures& live, Workspace& workspace, Actions& actions);

  private:
    void show_methods(const std::string& paths);
    void show_space();
    void update();

    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    std::vector<QAction*> adding_;
    QAction* space_;
};

}  // namespace ir::gui
