#pragma once

#include <QObject>

#include "app/engine/film.h"
#include "app/gui/actions.h"
#include "app/gui/file_job.h"
#include "app/gui/preferences.h"
#include "app/gui/workspace.h"

namespace ir::gui {

class FilmDialog;

/// Films of the experiment that is worked on. A child of the window.
class FilmController : public QObject {
    Q_OBJECT
  public:
    FilmController(QWidget& window, Session& session, LivePictures& live, Workspace& workspace,
                   const Preferences& preferences, Notices& notices, Actions& actions);

    /// What a film shows, with a copy of the document, so that edits go on meanwhile.
    struct Request {
        projects::Project project;
        projects::Experiment experiment;
        std::filesystem::path folder;
        engine::Film film;
        engine::MachineOptions machine = {};
        std::uint64_t memory_budget = 0;
    };
    /// Makes a film, on a thread of its own.
    using Maker = std::function<std::vector<Message>(const Request& request, const CancelToken& cancel,
                                                     const ProgressCallback& progress)>;
    /// Another way to make films, for tests.
    void set_maker(Maker maker) { make_ = std::move(maker); }
    bool is_making() const { return job_.is_running(); }
    /// Asks nothing.
    void make(engine::Film film);

  private:
    void open();
    void ask(bool for_video);
    void update();

    QWidget& window_;
    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    const Preferences& preferences_;
    Notices& notices_;
    QAction* action_;
    FileJob job_;
    Maker make_;
    FilmDialog* dialog_ = nullptr;  ///< while it is open
};

}  // namespace ir::gui
