#pragma once

#include "widgets/document/item_form.h"

namespace ir::widgets {

class ChoiceField;
class ExperimentChecks;
class NotesField;
class NumberField;

/// An analysis: what is asked, about which experiments, by which reference; says what is wrong with it.
class AnalysisEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit AnalysisEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    ChoiceField* choice_row(QGridLayout* grid, const char* key);

    TextField *name_, *parameters_;
    ChoiceField *kind_, *reference_, *output_;
    NumberField* frames_;
    ExperimentChecks* experiments_;
    QLabel *doc_, *problem_;
    NotesField* notes_;
};

}  // namespace ir::widgets
