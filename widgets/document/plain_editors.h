#pragma once

#include "widgets/document/item_form.h"
#include "widgets/parameters/option.h"

class QCheckBox;
class QToolButton;

namespace ir::widgets {

class ChoiceField;
class NotesField;
class VectorField;

/// Name and notes of the project.
class ProjectEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit ProjectEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    TextField* name_;
    NotesField* notes_;
};

/// Name, reference and notes of an experiment; its values have a panel of their own.
class ExperimentEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit ExperimentEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    using Maker = projects::EditPtr (*)(const projects::Project&, const std::string&, const std::string&);
    ChoiceField* choice_row(QGridLayout* grid, const char* name, const QString& label, const QString& tip,
                            Maker make);
    TextField* name_;
    ChoiceField *scene_, *camera_, *lights_, *reference_;
    QLabel* method_;
    NotesField* notes_;
};

/// Two pictures, how they are compared, and notes.
class ComparisonEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit ComparisonEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;
    void set_modes(const std::vector<Option>& modes) { modes_ = modes; }

  private:
    ChoiceField* choice_row(QGridLayout* grid, const char* key);
    void make_range_rows(QGridLayout* grid);
    TextField* name_;
    ChoiceField *a_, *b_, *output_, *mode_;
    QCheckBox* automatic_;
    VectorField* range_;
    NotesField* notes_;
    std::vector<Option> modes_;
};

/// A picture from elsewhere: its file, and what it shows.
class ImageEditor : public ItemForm {
    Q_OBJECT
  public:
    explicit ImageEditor(QWidget* parent = nullptr);
    void show_item(const ShownProject& shown, const ItemRef& item) override;

  private:
    TextField *name_, *file_;
    QToolButton* browse_;
    NotesField* notes_;
};

}  // namespace ir::widgets
