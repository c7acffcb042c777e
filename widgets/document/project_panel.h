#pragma once

#include <QHash>
#include <QSet>
#include <QWidget>

#include "widgets/document/edit_maker.h"
#include "widgets/document/item_ref.h"

class QAction;
class QLineEdit;
class QMenu;
class QToolButton;

namespace ir::widgets {

class ProjectModel;
class ProjectTree;
class ProjectFilter;

/// The project's items as a tree with a filter; adds, duplicates, renames, removes and reorders by buttons,
/// menu, keys and drags. Changes are asked for by edit_wanted; after each, set_project() shows the outcome.
class ProjectPanel : public QWidget {
    Q_OBJECT
  public:
    explicit ProjectPanel(QWidget* parent = nullptr);
    /// To be called after every change. `why` says why a read-only project is so.
    void set_project(const projects::Project& project, const Registry& registry, bool read_only,
                     const QString& why);
    /// No project.
    void clear();
    void set_current_experiment(const QString& id);
    void set_stale(const QSet<QString>& experiments);            ///< see ProjectModel
    void set_problems(const QHash<QString, QString>& problems);  ///< see ProjectModel

    /// Selects it in the tree, as a click does.
    void select(const ItemRef& item);
    ItemRef selected() const;
    ProjectModel& model() { return *model_; }
    ProjectTree* view() { return view_; }

  signals:
    void edit_wanted(const ir::widgets::EditMaker& make);
    void gesture_finished();
    void item_selected(const ir::widgets::ItemRef& item);
    /// Double click or Enter: look at this experiment, through this camera, at this comparison, …
    void item_activated(const ir::widgets::ItemRef& item);
    /// For what the panel cannot add itself: scene, part (owner: the scene), camera (bookmark the view),
    /// experiment, image, sweep.
    void add_wanted(ir::widgets::ItemKind kind, const ir::widgets::ItemRef& owner);

  private:
    QAction* add_action(const char* name, const QString& text, const char* icon, const QString& key,
                        void (ProjectPanel::*run)());
    void make_add_menu();
    void make_buttons();
    void add(ItemKind kind);
    void remove_selected();
    void duplicate_selected();
    void rename_selected();
    void move_up();
    void move_down();
    void move_selected(int steps);
    void edit(const EditMaker& make, bool select_new = false);
    void update_actions();
    void show_menu(const QPoint& position);
    void select_what_is_new(const QSet<QString>& before);
    QSet<QString> keys() const;
    QString why_not(const char* action) const;

    ProjectModel* model_;
    ProjectFilter* filter_;
    ProjectTree* view_;
    QLineEdit* filter_line_;
    QMenu* add_menu_;
    QHash<QString, QAction*> actions_;
    bool read_only_ = false, has_project_ = false, select_new_ = false;
    QString why_read_only_;
    ItemRef announced_;
};

}  // namespace ir::widgets
