#pragma once

#include <QObject>
#include <filesystem>
#include <functional>
#include <string>

#include "app/gui/actions.h"
#include "app/gui/file_job.h"
#include "app/gui/session.h"
#include "app/report/make_report.h"

namespace ir::gui {

/// Writes a report of the open project on a thread of its own, with progress and a way to stop, and opens it.
class ReportController : public QObject {
    Q_OBJECT
  public:
    ReportController(QWidget& window, Session& session, Notices& notices, Actions& actions);

    /// Writes a report into a file, on the report's thread.
    using Maker = std::function<void(const std::string& file, const report::Work& work)>;
    /// Asks nothing. Of the document as it is now, saved or not.
    void write_to(const QString& file);
    /// With another way to make it, for tests.
    void write_to(const QString& file, const Maker& make);
    bool is_writing() const { return job_.is_running(); }
    /// Of the lists and pictures that a sweep has left in a folder.
    static Maker of_sweep(const std::filesystem::path& folder);
    /// Asks where it is to be written.
    void ask_for_sweep(const std::filesystem::path& folder, const QString& title);

  private:
    /// Empty: nowhere.
    QString ask_for_file(const QString& title);
    void update();

    QWidget& window_;
    Session& session_;
    Notices& notices_;
    QAction* action_;
    FileJob job_;
};

}  // namespace ir::gui
