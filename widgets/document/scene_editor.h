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

  signals:
    /// Another file is to be added to this scene.
    void add_wanted(ir::widgets::ItemKind kind, const ir::widgets::ItemRef& scene);

  private:
    void make_list(QGridLayout* grid);
    void make_part();
    void make_variant(QGridLayout* grid);
    void show_part();
    void show_variant(const QStringList& known, const QString& chosen);
    ItemRef part(int index) const;

    TextField *name_, *source_;
    OrderedList* list_;
    QToolButton* browse_;
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
