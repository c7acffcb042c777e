#pragma once

#include "widgets/document/item_form.h"

class QCheckBox;
class QMenu;
class QToolButton;

namespace ir::widgets {

class ChoiceField;
class ColourField;
class LightForm;
class OrderedList;

/// A set of lights by values, and its environment.
class LightSetEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit LightSetEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;
    /// Whose values are shown; none: the set has no light.
    ItemRef chosen_light() const { return lights_.empty() ? ItemRef() : light(chosen_); }

  signals:
    void light_chosen();

  private:
    void make_list(QGridLayout* grid);
    QMenu* make_add_menu();
    void make_environment(QGridLayout* grid);
    void show_lights(const projects::LightSet& set);
    void show_environment(const projects::Environment& environment);
    void choose_environment(const QString& kind);
    ItemRef light(int index) const;

    TextField *name_, *map_;
    QCheckBox* scene_lights_;
    OrderedList* list_;
    LightForm* form_;
    QLabel *hint_, *constant_label_, *map_label_;
    ChoiceField* environment_;
    ColourField* constant_;
    QWidget* map_box_;
    QToolButton* browse_;
    ItemRef shown_item_;
    int chosen_ = 0;
    std::vector<projects::LightSpec> lights_;
};

}  // namespace ir::widgets
