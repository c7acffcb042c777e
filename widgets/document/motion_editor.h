#pragma once

#include "widgets/document/item_form.h"

namespace ir::widgets {

class ChoiceField;
class NumberField;
class OrderedList;
class VectorField;

/// Poses of a camera over time, key by key.
class MotionEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit MotionEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;
    /// New keys take the view's pose; without one, that of the last key.
    void set_view_pose(std::function<std::optional<CameraPose>()> pose) { view_pose_ = std::move(pose); }

  private:
    using Key = projects::Motion::Key;
    void make_keys(QGridLayout* grid);
    VectorField* vector_row(QGridLayout* grid, const char* name, const QString& label, const QString& tip,
                            glm::dvec3 Key::*member);
    void change_key(const std::string& field, const std::function<void(Key&)>& change);
    void add_key(const Key& key, double time);
    void show_key();

    TextField* name_;
    ChoiceField* camera_;
    OrderedList* list_;
    NumberField* time_;
    VectorField *eye_, *target_, *up_;
    std::function<std::optional<CameraPose>()> view_pose_;
    ItemRef shown_item_;
    int chosen_ = 0;
    projects::Motion motion_;
};

}  // namespace ir::widgets
