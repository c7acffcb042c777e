#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/exports.h"
#include "app/gui/notices.h"

namespace ir::gui {

/// Exports of the active view: asks where to, and says what became of it.
class ExportController : public QObject {
    Q_OBJECT
  public:
    ExportController(QWidget& window, Session& session, Renderer& renderer, Workspace& workspace,
                     const Exports& exports, Notices& notices, Actions& actions);

  private:
    using Save = void (Exports::*)(const QString& file) const;
    void copy_view();
    void export_to(const QString& suffix, const QString& filter, Save save);

    QWidget& window_;
    const Exports& exports_;
    Notices& notices_;
};

}  // namespace ir::gui
