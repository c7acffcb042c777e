#pragma once

#include <QObject>
#include <utility>

#include "app/gui/actions.h"
#include "app/gui/pixel_inspector.h"
#include "app/gui/playback.h"
#include "app/gui/scene_shelf.h"
#include "app/gui/workspace.h"
#include "widgets/inspect/display_panel.h"

namespace ir::gui {

/// What is done to the views by menu, key and the display panel.
class ViewController : public QObject {
    Q_OBJECT
  public:
    ViewController(Session& session, LivePictures& live, Playback& playback, SceneShelf& scenes,
                   Workspace& workspace, PixelInspector& inspector, widgets::DisplayPanel& display,
                   Actions& actions);

  private:
    QAction* add(const char* name, const QString& text, const char* icon, const QList<QKeySequence>& keys,
                 std::function<void()> run);
    void add_view_actions();
    void add_display_actions();
    void add_arrangement_actions();
    void add_compare_actions();
    void add_inspect_actions();
    void add_tool_actions();
    void step_output(int step);
    void show_stages();  ///< the chain that the method names, in a row
    void change_display(const std::function<void(widgets::Display&)>& change);
    void update_display();
    void update_switches();
    void update_stages();
    void update_cameras();

    Session& session_;
    SceneShelf& scenes_;
    Workspace& workspace_;
    ViewModel& views_;
    PixelInspector& inspector_;
    widgets::DisplayPanel& display_;
    Actions& actions_;
    QList<QAction*> all_;
    QList<std::pair<QAction*, bool widgets::Display::*>> switches_;
};

}  // namespace ir::gui
