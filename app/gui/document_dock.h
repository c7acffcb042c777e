#pragma once

#include <QWidget>

#include "app/gui/scene_shelf.h"
#include "app/gui/workspace.h"
#include "widgets/document/item_editor.h"
#include "widgets/document/project_panel.h"

namespace ir::gui {

/// The project as a tree over the values of the chosen item, joined to the session and the views.
class DocumentDock : public QWidget {
    Q_OBJECT
  public:
    DocumentDock(Session& session, SceneShelf& scenes, Workspace& workspace, QWidget* parent = nullptr);
    widgets::ProjectPanel& tree() { return *tree_; }
    widgets::ItemEditor& editor() { return *editor_; }
    void select(const widgets::ItemRef& item) { tree_->select(item); }
    /// Another analysis is shown: so it is in the form, where that shows one.
    void follow_analysis(const QString& id) {
        const auto kind = widgets::ItemKind::analysis;
        if (editor().item().kind == kind && !id.isEmpty()) select({kind, id});
    }
    /// A file of a scene, and one of its materials; empty: none.
    void show_surface(const widgets::ItemRef& part, const QString& material) {
        tree_->select(part);
        editor_->show_surface(part, material);
    }
    /// Takes over what is being typed: before saving.
    void commit() { editor_->commit(); }

    void add_scene();
    void add_image();
    void add_comparison();
    void add_experiment();

  private:
    void update_document();
    void update_facts();
    void update_files();
    void connect_panels();
    void activate(const widgets::ItemRef& item);
    void add(widgets::ItemKind kind, const widgets::ItemRef& owner);
    void browse(const widgets::ItemRef& item);
    void use_in_experiment(const widgets::ItemRef& item);
    std::string choose_scene_file();
    std::string choose_image_file(const QString& title);
    std::string source_of(const std::string& file) const;

    Session& session_;
    SceneShelf& scenes_;
    Workspace& workspace_;
    widgets::ProjectPanel* tree_;
    widgets::ItemEditor* editor_;
};

}  // namespace ir::gui
