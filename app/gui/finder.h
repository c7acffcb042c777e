#pragma once

#include <QObject>
#include <vector>

#include "app/gui/dock_layout.h"
#include "app/gui/document_dock.h"
#include "app/gui/file_controller.h"
#include "app/gui/layout_controller.h"
#include "app/gui/parameter_dock.h"
#include "widgets/panels/finder_dialog.h"

namespace ir::gui {

/// One box for everything that has a name: what the active view may show, parameters, items of the project,
/// cameras of the scene, actions also of panels, own layouts, built-in scenes, samples and pages of the
/// manual.
class Finder : public QObject {
    Q_OBJECT
  public:
    Finder(QWidget& window, Session& session, const SceneShelf& scenes, Workspace& workspace,
           DocumentDock& document, ParameterDock& parameters, DockLayout& docks, LayoutController& layouts,
           FileController& files, Actions& actions);
    void open();
    std::vector<widgets::Findable> all();
    /// Brings the parameters forward and gives this one the keyboard.
    void show_parameter(const std::string& key);
    /// What a double click on the item in the tree does.
    void go_to(const widgets::ItemRef& item);

  signals:
    void page_wanted(const QString& file);

  private:
    void add_buffers(std::vector<widgets::Findable>& all);
    void add_parameters(std::vector<widgets::Findable>& all);
    void add_items(std::vector<widgets::Findable>& all);
    void add_cameras(std::vector<widgets::Findable>& all);
    void run_once_seen(const QString& panel, const std::function<void()>& run);
    void add_panels(std::vector<widgets::Findable>& all);
    void add_actions(std::vector<widgets::Findable>& all);
    void add_layouts(std::vector<widgets::Findable>& all);
    void add_samples(std::vector<widgets::Findable>& all);
    void add_pages(std::vector<widgets::Findable>& all);

    QWidget& window_;
    Session& session_;
    const SceneShelf& scenes_;
    Workspace& workspace_;
    DocumentDock& document_;
    ParameterDock& parameters_;
    DockLayout& docks_;
    LayoutController& layouts_;
    FileController& files_;
    Actions& actions_;
};

}  // namespace ir::gui
