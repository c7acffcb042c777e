#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/workspace.h"

namespace ir::gui {

/// Sets a question up in one click, at the place of the experiment that is worked on.
class SetUpController : public QObject {
    Q_OBJECT
  public:
    SetUpController(QWidget& window, Session& session, LivePictures& live, Workspace& workspace,
                    Actions& actions);

    /// As the command line calls them, in the order of their cards.
    static QStringList names();
    static QString action_of(const QString& name);

  private:
    void show_cards();
    void show_methods(const std::string& paths);
    void show_space();
    void update();

    QWidget& window_;
    Actions& actions_;
    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    std::vector<QAction*> adding_;
    QAction* space_;
};

}  // namespace ir::gui
