#pragma once

#include <optional>

#include "app/gui/actions.h"
#include "app/gui/dock_layout.h"
#include "app/gui/document_dock.h"

namespace ir::gui {

/// The light that is chosen in the project has handles in the views of experiments that it lights; a drag of
/// one is one step of undo.
class LightMover : public QObject {
    Q_OBJECT
  public:
    LightMover(Session& session, Workspace& workspace, DocumentDock& document, DockLayout& docks,
               Actions& actions);

  private:
    struct Gesture {
        std::string field;
        projects::LightSet before;
    };
    void update();
    void update_view(int view);
    std::optional<widgets::PlacedLight> placed() const;
    bool has_handles(const widgets::ViewState& state, widgets::ViewPane& pane, int number) const;
    bool shows_lit(const widgets::ViewSource& source, const widgets::Picture* picture) const;
    void change(const char* what, const std::function<void(projects::LightSpec&)>& change);
    void finish(bool kept);

    Session& session_;
    Workspace& workspace_;
    DockLayout& docks_;
    widgets::ItemRef light_;  ///< that is chosen; none: there is none
    bool shown_ = true;
    std::optional<Gesture> gesture_;
};

}  // namespace ir::gui
