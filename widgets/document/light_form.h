#pragma once

#include <QWidget>
#include <functional>

#include "projects/document_fields.h"

class QGridLayout;
class QLabel;

namespace ir::widgets {

class ChoiceField;
class ColourField;
class NumberField;

/// The light as another type: what both have stays, what the type needs gets a value.
projects::LightSpec with_type(const projects::LightSpec& light, projects::LightSpec::Type type);
/// The amount in another quantity; the light stays as bright.
projects::LightSpec with_quantity(const projects::LightSpec& light, projects::LightSpec::Quantity quantity);

/// All values of one light.
class LightForm : public QWidget {
    Q_OBJECT
  public:
    using Change = std::function<void(projects::LightSpec&)>;

    explicit LightForm(QWidget* parent);
    void show_light(const projects::LightSpec& light);
    void set_usable(const QString& why_not);

  signals:
    /// `field` names what is changed; those that do not merge are single choices.
    void change_wanted(const QString& field, const ir::widgets::LightForm::Change& change, bool merges);
    void finished();

  private:
    struct FormRow {
        QLabel* label;
        QWidget* control;
        const projects::Field<projects::LightSpec>* field;  ///< null: a choice, the strength or the colour
    };
    QWidget* add(const QString& label, QWidget* control, const QString& tip);
    void make_strength_rows();
    void make_colour_row(const projects::Field<projects::LightSpec>& field);
    void make_aim_row();
    void make_field_row(const projects::Field<projects::LightSpec>& field);
    void set_shown(QWidget* control, bool shown);

    QGridLayout* grid_;
    std::vector<FormRow> rows_;
    ChoiceField *type_, *quantity_, *aim_;
    NumberField* amount_;
    ColourField* colour_;
};

}  // namespace ir::widgets
