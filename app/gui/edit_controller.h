#pragma once

#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/document_dock.h"

namespace ir::gui {

/// Edits of the document by menu and key: undo, experiments, scenes, images and bookmarks.
class EditController : public QObject {
    Q_OBJECT
  public:
    EditController(Session& session, DocumentDock& document, Actions& actions);

  signals:
    /// What is chosen in the project's dock is to be edited there.
    void edit_wanted();

  private:
    void duplicate_experiment();
    void remove_experiment();
    void update();

    Session& session_;
    DocumentDock& document_;
    Actions& actions_;
};

}  // namespace ir::gui
