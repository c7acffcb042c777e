#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/file_job.h"
#include "app/gui/workspace.h"
#include "widgets/timeline/frames_panel.h"

namespace ir::gui {

/// Joins the panel of the last frames, and keys, to those that are kept: goes through them, saves them, and
/// makes an experiment of one and an analysis of all.
class FramesDock : public QObject {
    Q_OBJECT
  public:
    using Film = widgets::FramesPanel::Film;
    FramesDock(QWidget& window, Session& session, LivePictures& live, Workspace& workspace, Notices& notices,
               Actions& actions);

    widgets::FramesPanel& panel() { return *panel_; }
    /// The kept frames of what the active view shows, into a folder or a video. Asks nothing.
    void save_film(Film film, const QString& file);
    bool is_saving() const { return job_.is_running(); }
    /// As many frames of what the active view shows, as an analysis of the project.
    void keep_frames();

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void analysis_added();

  private:
    void update();
    void choose(int frame);
    void ask(Film film);
    void add_experiment();
    QString why_not_kept() const;
    const PastFrame* chosen() const;  ///< of the experiment that is worked on; null: now, or none
    QString caption() const;
    std::vector<std::shared_ptr<const engine::LiveResult>> film_frames(engine::Part& part) const;

    QWidget& window_;
    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    PastFrames& past_;
    Actions& actions_;
    widgets::FramesPanel* panel_;
    FileJob job_;
};

}  // namespace ir::gui
