#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/frame_lists.h"
#include "app/gui/notices.h"
#include "app/gui/pixel_inspector.h"
#include "widgets/pipeline/pipeline_panel.h"

class QMenu;

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
    void wanted();                            ///< a pixel is traced: somebody wants to see the panel
    void shader_wanted(const QString& file);  ///< to be opened
    void copy_wanted(const QString& file);    ///< likewise, a copy for the experiment

  private:
    void update();
    void show_step(const std::string& pass);
    /// Pictures are those of the whole frame again.
    void leave_frame();
    void trace(std::optional<QPoint> pixel);
    void show_pass_menu(const QString& pass, QPoint global_position);
    void add_shaders(QMenu& menu, const PassReport& pass);
    void add_buffers(QMenu& menu, const FrameReport& report, const PassReport& pass);
    void write_svg();
    std::string experiment() const;  ///< of the active view; empty: none
    Pipeline pipeline() const;

    Session& session_;
    LivePictures& live_;
    ViewModel& views_;
    PixelInspector& inspector_;
    FrameLists& lists_;
    Notices& notices_;
    Actions& actions_;
    widgets::PipelinePanel* panel_;
    bool visible_ = false;
};

}  // namespace ir::gui
