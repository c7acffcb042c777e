#pragma once

#include <QObject>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "app/gui/actions.h"
#include "app/gui/document_dock.h"
#include "app/gui/file_job.h"
#include "app/gui/live_pictures.h"
#include "app/gui/session.h"
#include "app/report/make_report.h"

namespace ir::gui {

class UnkeptFiles;

/// Writes a report of the open project on a thread of its own, with progress and a way to stop, and opens it.
class ReportController : public QObject {
    Q_OBJECT
  public:
    ReportController(QWidget& window, Session& session, LivePictures& live, Renderer& renderer,
                     DocumentDock& document, Notices& notices, Actions& actions);

    /// Writes a report into a file, on the report's thread.
    using Maker = std::function<void(const std::string& file, const report::Work& work)>;
    /// Asks nothing. Of the document as it is now, saved or not: kept pictures, and where none is kept or it
    /// is stale those that views show, which are waited for.
    void write_to(const QString& file);
    /// The same of a comparison, by its id. It is shown where its pictures are neither kept nor shown.
    void write_comparison_to(const QString& file, const std::string& comparison);
    /// With another way to make it, for tests.
    void write_to(const QString& file, const Maker& make);
    bool is_writing() const { return job_.is_running(); }
    /// Of the lists and pictures that a sweep has left in a folder.
    static Maker of_sweep(const std::filesystem::path& folder);
    /// Asks where it is to be written.
    void ask_for_sweep(const QString& folder, const QString& title);

  private:
    /// Empty: nowhere.
    QString ask_for_file(const QString& title);
    void update();
    QString why_not() const;
    void fill_menu(const widgets::ItemRef& item, QMenu* menu);
    void write(const QString& file, const std::string& comparison);
    /// What is not kept as the project has it now, of what the report is of.
    std::vector<std::string> lacking(const report::Subject& subject) const;
    /// Of what views show and nothing keeps.
    std::shared_ptr<UnkeptFiles> ask_for_unkept(const report::Subject& subject);
    /// A picture that is waited for may be there now, or will not come.
    void look_at(const std::string& experiment);
    void take(const std::string& experiment, const std::string& file, const std::string& error);
    /// Why the report will have no picture of an experiment that is shown; empty: it will have one.
    QString why_no_picture(const std::string& experiment) const;
    /// Why what is shown is not what the document asks for; empty: it is.
    QString why_not_its_own(const std::string& experiment) const;

    QWidget& window_;
    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    DocumentDock& document_;
    Notices& notices_;
    QAction* action_;
    std::shared_ptr<UnkeptFiles> unkept_;  ///< of the report that is written; null: it waits for none
    FileJob job_;
};

}  // namespace ir::gui
