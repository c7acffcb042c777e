#pragma once

#include "app/gui/actions.h"
#include "app/gui/live_pictures.h"
#include "app/gui/notices.h"
#include "app/gui/pipeline_dock.h"
#include "app/gui/shader_copies.h"
#include "app/gui/shader_dock.h"

namespace ir::gui {

/// Edits copies of shaders for the experiment that is worked on, and shows what it changes in them.
class ShaderController : public QObject {
    Q_OBJECT
  public:
    ShaderController(QWidget& window, Session& session, LivePictures& live, ShaderDock& dock,
                     PipelineDock& pipeline, Notices& notices, Actions& actions);

  private:
    void choose();
    void open(const QString& file);  ///< as the program has it
    void edit_copy(const QString& file);
    void edit(std::string experiment, std::string file, int line);
    void edit_fault(const ShaderFault& fault);
    void copy_path(const QString& file);
    void remove_change(const QString& file);
    void update();

    QWidget& window_;
    Session& session_;
    LivePictures& live_;
    ShaderDock& dock_;
    Notices& notices_;
    ShaderCopies copies_;
    QAction* action_;
};

}  // namespace ir::gui
