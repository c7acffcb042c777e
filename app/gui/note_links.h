#pragma once

#include <QUrl>

#include "app/gui/finder.h"
#include "app/gui/notices.h"
#include "app/gui/pixel_inspector.h"
#include "projects/note_links.h"
#include "widgets/panels/notes_strip.h"

namespace ir::gui {

/// Follows links in the project's notes to places in the window. What is not there is said. Web pages open in
/// the desktop's browser; nothing else leads out of the window.
class NoteLinks : public QObject {
    Q_OBJECT
  public:
    NoteLinks(const widgets::NotesStrip& notes, Session& session, Workspace& workspace,
              PixelInspector& inspector, DockLayout& docks, Finder& finder, Notices& notices);

  private:
    void follow(const QUrl& link);
    /// Why not; empty: there.
    QString go_to(const projects::NoteLink& link);
    QString go_to_view(const QString& number);
    QString go_to_pin(const QString& number);
    QString go_to_parameter(const std::string& key);
    QString go_to_experiment(const std::string& id);
    QString go_to_buffer(const std::string& key);

    Session& session_;
    Workspace& workspace_;
    PixelInspector& inspector_;
    DockLayout& docks_;
    Finder& finder_;
    Notices& notices_;
};

}  // namespace ir::gui
