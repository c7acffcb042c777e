#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/known_projects.h"
#include "app/gui/notices.h"
#include "app/gui/workspace.h"
#include "widgets/panels/welcome_page.h"

class QMenu;

namespace ir::gui {

/// The project as a file: begun, opened, saved and closed, with the projects known from before.
class FileController : public QObject {
    Q_OBJECT
  public:
    /// Without `remember` no project is known from before.
    FileController(QWidget& window, Session& session, Workspace& workspace, Notices& notices,
                   widgets::WelcomePage& welcome, Actions& actions, bool remember);
    QMenu* recent_menu() { return recent_menu_; }

    /// A project, a scene file or builtin:NAME; failures become a banner and a message. Asks nothing. A
    /// sample is opened as a copy.
    bool open(const QString& path);
    /// A scene or an image becomes a part of the open project, everything else is opened.
    void take(const QString& file);
    /// Opens it where what is open may go.
    void go_to(const QString& path);
    /// That come with the program, without their pictures.
    std::vector<widgets::SampleProject> samples() const { return samples_.all(false); }
    bool save_as();
    /// Whether what is open may go: asks where something would be lost.
    bool may_discard();

  signals:
    /// The project is about to be saved or closed: what is being typed belongs to it.
    void ending();

  private:
    bool save();
    void close();
    void new_project();
    void choose_project();
    QImage save_thumbnail();
    void show_as_saved(const QImage& thumbnail);
    void update_recent();
    void say_copy(const QString& sample, const projects::SampleCopy& copy);
    void begin_sample_afresh(const QString& sample, const projects::SampleCopy& copy);
    void update_actions();

    QWidget& window_;
    Session& session_;
    Workspace& workspace_;
    Notices& notices_;
    Actions& actions_;
    widgets::WelcomePage& welcome_;
    RecentProjects recent_;
    std::vector<widgets::RecentProject> listed_;  ///< on the start page
    Samples samples_;
    QMenu* recent_menu_;
};

}  // namespace ir::gui
