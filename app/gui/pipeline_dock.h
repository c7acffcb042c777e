#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/frame_lists.h"
#include "app/gui/notices.h"
#include "app/gui/pixel_inspector.h"
#include "widgets/pipeline/pipeline_panel.h"

namespace ir::gui {

/// Keeps the panel of the frame's passes at the newest frame of the active view's experiment, and leads the
/// views through it.
class PipelineDock : public QObject {
    Q_OBJECT
  public:
    PipelineDock(Session& session, LivePictures& live, ViewModel& views, PixelInspector& inspector,
                 FrameLists& lists, Notices& notices, Actions& actions);

    widgets::PipelinePanel& panel() { return *panel_; }
    void set_visible(bool visible);
    bool is_settled() const { return !visible_ || !panel_->view().is_placing(); }

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  signals:
    void wanted();  ///< a pixel is traced: somebody wants to see the panel

  private:
    void update();
    void show_step(const std::string& pass);
    /// Pictures are those of the whole frame again.
    void leave_frame();
    void trace(std::optional<QPoint> pixel);
    void write_svg();
    std::string experiment() const;  ///< of the active view; empty: none
    Pipeline pipeline() const;

    Session& session_;
    LivePictures& live_;
    ViewModel& views_;
    PixelInspector& inspector_;
    FrameLists& lists_;
    Notices& notices_;
    widgets::PipelinePanel* panel_;
    bool visible_ = false;
};

}  // namespace ir::gui
