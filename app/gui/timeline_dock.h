#pragma once

#include <QWidget>

#include "app/gui/actions.h"
#include "app/gui/playback.h"
#include "widgets/timeline/timeline_panel.h"

namespace ir::gui {

/// Joins the timeline's panel, and keys, to time as it passes.
class TimelineDock : public QWidget {
    Q_OBJECT
  public:
    TimelineDock(Session& session, LivePictures& live, Playback& playback, Actions& actions);
    widgets::TimelinePanel& panel() { return *panel_; }

  private:
    void add_actions(Actions& actions);
    void update_panel();
    std::vector<widgets::TimelineTrack> tracks() const;

    Session& session_;
    LivePictures& live_;
    Playback& playback_;
    widgets::TimelinePanel* panel_;
};

}  // namespace ir::gui
