#pragma once

#include <QObject>
#include <QStringList>
#include <thread>

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
    ~ExportController() override;
    const Exports& exports() const { return exports_; }
    /// Shows the active view's buffer in the program tev, on a thread of its own.
    void show_in_tev(const std::string& address);

  private:
    using Save = void (Exports::*)(const QString& file) const;
    void copy_view();
    void export_to(const QString& suffix, const QString& filter, Save save);

    QWidget& window_;
    const Exports& exports_;
    Notices& notices_;
    QStringList asked_;  ///< files that the renderer is to write
    std::thread tev_;
    bool is_sending_ = false;
};

}  // namespace ir::gui
