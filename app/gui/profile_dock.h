#pragma once

#include <QObject>

#include "app/gui/workspace.h"
#include "widgets/profile/profile_panel.h"

namespace ir::gui {

/// Keeps the profile panel at the pictures that the views show, the line and the rectangle. Measures only
/// while the panel is seen.
class ProfileDock : public QObject {
    Q_OBJECT
  public:
    ProfileDock(Session& session, Workspace& workspace);

    widgets::ProfilePanel& panel() { return *panel_; }
    void set_visible(bool visible);
    bool is_settled() const { return !panel_->is_computing(); }

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    /// A line was drawn, or a rectangle, and the panel is not seen.
    void line_drawn();
    void rectangle_drawn();
    /// The panel came with one of them, and none is left.
    void emptied();

  private:
    std::vector<widgets::ShownPicture> shown_pictures(bool& awaits) const;
    void update();
    void on_drawn();
    void mark(QPoint pixel);

    Session& session_;
    Workspace& workspace_;
    widgets::ProfilePanel* panel_;
    bool visible_ = false, came_by_drawing_ = false;
};

}  // namespace ir::gui
