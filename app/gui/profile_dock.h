#pragma once

#include <QLine>
#include <QObject>
#include <QRect>
#include <utility>

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
    /// Metrics measure a rectangle, too: seen, they are enough for one.
    void set_visible(bool visible, bool metrics_visible);
    /// The window closes: a panel that came by drawing is not open at the next start.
    void leave();
    bool is_settled() const { return !panel_->is_computing(); }

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    /// Something was drawn that nobody tells the values of.
    void drawn();
    /// The panel came with one of them, and none is left.
    void emptied();

  private:
    void update();
    void on_drawn();
    void mark(QPoint pixel);

    Session& session_;
    Workspace& workspace_;
    widgets::ProfilePanel* panel_;
    std::pair<QLine, QRect> last_drawn_;
    bool visible_ = false, metrics_visible_ = false, came_by_drawing_ = false;
};

}  // namespace ir::gui
