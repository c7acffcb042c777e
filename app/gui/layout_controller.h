#pragma once

#include <QMap>
#include <QObject>

#include "app/gui/actions.h"
#include "app/gui/dock_layout.h"

class QMenu;

namespace ir::gui {

class Workspace;

/// Layouts of the window by name: the program's, and a person's own, which all projects share. A child of the
/// window.
class LayoutController : public QObject {
    Q_OBJECT
  public:
    /// Own layouts are read and kept where `remember` is set.
    LayoutController(QMainWindow& window, DockLayout& docks, Workspace& workspace, Actions& actions,
                     bool remember);

    QMenu* menu() const { return menu_; }
    QStringList names() const { return own_.keys(); }  ///< of own ones
    /// Panels and views as they stand. An own layout of that name is replaced.
    void keep(const QString& name);
    void apply(const QString& name);  ///< an own one
    void remove(const QString& name);
    void end_pictures_alone();  ///< panels are back, where they were hidden

  private:
    struct Own {
        QByteArray docks, views;
    };
    bool compare();
    void ask_for_name();
    void ask_to_remove(const QString& name);
    void show_pictures_alone(bool alone);
    void fill_menu();
    void write() const;

    QMainWindow& window_;
    DockLayout& docks_;
    Workspace& workspace_;
    Actions& actions_;
    const bool remember_;
    QMap<QString, Own> own_;
    QMenu *menu_, *removed_;
    QAction* alone_;
    QByteArray before_;  ///< the panels, while pictures are alone
};

}  // namespace ir::gui
