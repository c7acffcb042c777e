#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "widgets/document/item_form.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QToolButton;

namespace ir::widgets {

class ColourField;
class NumberField;

/// What a part changes of its file's materials, one material at a time. Values that are not ticked stay as
/// the file has them.
class MaterialForm : public QWidget {
    Q_OBJECT
  public:
    using Overrides = std::map<std::string, projects::MaterialOverride>;
    using Change = std::function<void(projects::MaterialOverride&)>;

    explicit MaterialForm(QWidget* parent);
    /// `known` are the file's materials, as far as somebody told.
    void show_materials(const Overrides& overrides, const std::vector<MaterialFacts>& known);
    void set_usable(const QString& why_not);
    const QString& material() const { return material_; }
    void show_material(const QString& name);
    QToolButton* pick() const { return pick_; }
    QComboBox* names() const { return names_; }

  signals:
    void change_wanted(const QString& material, const QString& field,
                       const ir::widgets::MaterialForm::Change& change, bool merges);
    void finished();

  private:
    struct FormRow {
        QCheckBox* tick;
        QWidget* field;
        std::function<bool(const projects::MaterialOverride&)> has;
        std::function<void(const projects::MaterialOverride&)> show;
    };
    QCheckBox* add_tick(const projects::FieldText& text, QWidget* field);
    void add_field(const projects::Field<projects::MaterialOverride>& field);
    void fill_names();
    void show_values();

    QComboBox* names_;
    QToolButton *pick_, *reset_;
    QLabel* hint_;
    QGridLayout* grid_;
    std::vector<FormRow> rows_;
    Overrides overrides_;
    std::vector<MaterialFacts> known_;
    QString material_, why_not_;
};

}  // namespace ir::widgets
