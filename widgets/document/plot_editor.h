#pragma once

#include "widgets/document/item_form.h"

namespace ir::widgets {

class ChoiceField;
class ExperimentChecks;
class NotesField;

/// A plot of the error: what is judged by what, over which values, by which metric; says how many points that
/// makes.
class PlotEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit PlotEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    ChoiceField* choice_row(QGridLayout* grid, const char* key);
    void make_experiments(QGridLayout* grid);
    void make_values(QGridLayout* grid);
    void show_count(const ShownProject& shown);

    TextField *name_, *values_;
    ChoiceField *reference_, *over_, *metric_, *axis_;
    ExperimentChecks* experiments_;
    QLabel* count_;
    NotesField* notes_;
    projects::ErrorPlot plot_;
};

}  // namespace ir::widgets
