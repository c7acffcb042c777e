#pragma once

#include "widgets/document/item_form.h"

namespace ir::widgets {

class ChoiceField;
class NumberField;
class OrderedList;

/// What a camera, a light or a part of a scene does over time, key by key.
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
    void make_given_row(QGridLayout* grid);
    void make_field_row(QGridLayout* grid, projects::Motion::Kind kind, const projects::Field<Key>& field);
    void choose_given(const QString& given);
    void show_rows();
    void change_key(const std::string& field, const std::function<void(Key&)>& change);
    void add_key(const Key& key, double time);
    void show_key();

    TextField* name_;
    ChoiceField *moves_, *given_, *loop_, *smooth_;
    OrderedList* list_;
    NumberField* time_;
    struct Row {
        projects::Motion::Kind kind;
        QLabel* label;
        QWidget* control;
        const projects::Field<Key>* field;  ///< null: what keys give
    };
    std::vector<Row> rows_;
    std::function<std::optional<CameraPose>()> view_pose_;
    ItemRef shown_item_;
    int chosen_ = 0;
    projects::Motion motion_;
    Key rest_;  ///< where the thing stands without its motion
};

}  // namespace ir::widgets
