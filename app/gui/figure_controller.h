#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/figure_dialog.h"
#include "app/gui/notices.h"
#include "app/gui/workspace.h"

namespace ir::gui {

/// Figures for papers of what the views show.
class FigureController : public QObject {
    Q_OBJECT
  public:
    FigureController(QWidget& window, Session& session, Workspace& workspace, Notices& notices,
                     Actions& actions);

    bool is_settled() const { return !dialog_ || !dialog_->is_drawing(); }

    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  private:
    void open();
    void make_dialog();
    void offer_pictures();
    void offer_rectangle();
    void ask();

    QWidget& window_;
    Session& session_;
    Workspace& workspace_;
    Notices& notices_;
    FigureDialog* dialog_ = nullptr;
    projects::Json memory_;  ///< of the dialog, while there is none
};

}  // namespace ir::gui
