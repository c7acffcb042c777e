#pragma once

#include <QHash>
#include <QSet>
#include <QWidget>

#include "widgets/document/edit_maker.h"
#include "widgets/document/item_ref.h"

class QAction;
class QHBoxLayout;
class QKeySequence;
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
    /// As a double click does.
    void activate(const ItemRef& item);
    ProjectModel& model() { return *model_; }
    ProjectTree* view() { return view_; }

  signals:
    void edit_wanted(const ir::widgets::EditMaker& make);
    void gesture_finished();
    void item_selected(const ir::widgets::ItemRef& item);
    /// Double click or Enter: look at this experiment, through this camera, at this comparison, …
    void item_activated(const ir::widgets::ItemRef& item);
    /// For what the panel cannot add itself: scene, part (owner: the scene), camera (bookmark the view),
    /// experiment, image.
    void add_wanted(ir::widgets::ItemKind kind, const ir::widgets::ItemRef& owner);
    /// The context menu is about to be shown: others may add what they can do with the item.
    void menu_opening(const ir::widgets::ItemRef& item, QMenu* menu);

  private:
    QAction* add_action(const char* name, const QString& text, const char* drawing, const QKeySequence& key,
                        std::function<void()> run);
    void make_actions();
    QHBoxLayout* button_row();
    void fill_add_menu();
    void show_add_menu();
    void show_menu(const QPoint& position);
    void remove_selected();
    void duplicate_selected();
    void rename_selected();
    void move_selected(int steps);
    void move_to(const ItemRef& item, int position);
    void edit(const EditMaker& make, bool select_new = false);
    void announce();
    void update_actions();
    QSet<QString> keys() const;
    ItemRef newest(const QSet<QString>& before) const;
    ItemRef neighbour(const ItemRef& owner, ItemKind kind, int row) const;
    QString why_not(const QString& action) const;

    ProjectModel* model_;
    ProjectFilter* filter_;
    ProjectTree* view_;
    QLineEdit* filter_line_;
    QMenu* add_menu_;
    QHash<QString, QAction*> actions_;
    QToolButton* add_button_ = nullptr;
    const Registry* registry_ = nullptr;
    bool read_only_ = false, has_project_ = false;
    bool select_new_ = false;  ///< what the running edit adds becomes selected
    bool settling_ = false;    ///< the tree is being rebuilt: its selection means nothing
    QString why_read_only_;
    ItemRef announced_;
    ItemRef follow_;  ///< where the selected part or light will be after the running edit
};

}  // namespace ir::widgets
