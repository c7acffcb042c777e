#pragma once

#include <QStackedWidget>

#include "app/gui/workspace.h"
#include "widgets/inspect/display_panel.h"

namespace ir::widgets {
class LayerPanel;
}

namespace ir::gui {

/// How the active view shows what it shows: a picture's colours, or the layers of a view in space. A table
/// has neither.
class DisplayDock : public QStackedWidget {
    Q_OBJECT
  public:
    /// Owns the panel of pictures.
    DisplayDock(widgets::DisplayPanel* pictures, Workspace& workspace, ViewModel& views);

  private:
    void update();
    void update_layers(int view, widgets::ViewPane& pane);

    Workspace& workspace_;
    ViewModel& views_;
    widgets::DisplayPanel* pictures_;
    widgets::LayerPanel* layers_;
    QWidget* nothing_;
};

}  // namespace ir::gui
