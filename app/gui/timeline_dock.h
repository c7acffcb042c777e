#pragma once

#include <QWidget>

#include "app/gui/playback.h"
#include "widgets/timeline/timeline_panel.h"

namespace ir::gui {

/// Joins the timeline's panel to time as it passes.
class TimelineDock : public QWidget {
    Q_OBJECT
  public:
    TimelineDock(Session& session, LivePictures& live, Playback& playback, QWidget* parent = nullptr);
    widgets::TimelinePanel& panel() { return *panel_; }

  private:
    void update_panel();
    std::vector<widgets::TimelineTrack> tracks() const;

    Session& session_;
    LivePictures& live_;
    Playback& playback_;
    widgets::TimelinePanel* panel_;
};

}  // namespace ir::gui
