#pragma once

#include "widgets/document/item_form.h"

class QLabel;
class QToolButton;

namespace ir::widgets {

class ChoiceField;
class MaterialForm;
class OrderedList;
class TransformForm;

/// A scene: its files, where each stands, and what is changed of its materials.
class SceneEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit SceneEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;
    /// One of the scene's files, and one of its materials; empty: none. Returns the control that edits it.
    QWidget* show_surface(int part, const QString& material);
    /// Whether a click in a picture is waited for, and why none can be.
    void set_picking(bool on, const QString& why_not);

  signals:
    /// A click in a picture is to choose a file and a material, or is no longer waited for.
    void pick_wanted(bool on);
    /// Another file is to be added to this scene.
    void add_wanted(ir::widgets::ItemKind kind, const ir::widgets::ItemRef& scene);

  private:
    void make_list(QGridLayout* grid);
    void make_part();
    void make_variant(QGridLayout* grid);
    void show_parts();
    void show_part();
    void show_variant(const QStringList& known, const QString& chosen);
    ItemRef part(int index) const;

    TextField *name_, *source_;
    OrderedList* list_;
    QToolButton *browse_, *pick_;
    ChoiceField* variant_;
    QLabel* variant_label_;
    TransformForm* transform_;
    MaterialForm* materials_;
    ItemRef shown_item_;
    int chosen_ = 0;
    std::vector<projects::ScenePart> parts_;
    SceneFacts facts_;
};

}  // namespace ir::widgets
