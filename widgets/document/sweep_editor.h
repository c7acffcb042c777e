#pragma once

#include "widgets/document/item_form.h"

class QLineEdit;
class QToolButton;

namespace ir::widgets {

class ChoiceField;
class OrderedList;

/// A sweep: the experiment that is varied, and by axes what varies; says how many points that makes, and how
/// it is run.
class SweepEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit SweepEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    void make_axes(QGridLayout* grid);
    QString change_axes(const QString& field,
                        const std::function<void(std::vector<projects::Sweep::Axis>&)>& change, bool checks);
    void add_axis();
    void choose_key(const QString& key);
    void show_axis();
    void show_count(const ShownProject& shown);
    void make_command(QGridLayout* grid);
    void show_command(const CommandLine& line);

    TextField *name_, *values_;
    ChoiceField *experiment_, *key_;
    OrderedList* list_;
    QLabel *count_, *outcome_;
    QLineEdit* command_;
    QToolButton* copy_;
    ItemRef shown_item_;
    int chosen_ = 0;
    projects::Sweep sweep_;
    projects::Experiment base_;
    const Registry* registry_ = nullptr;
};

}  // namespace ir::widgets
