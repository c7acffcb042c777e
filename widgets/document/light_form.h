#pragma once

#include <QWidget>
#include <functional>

#include "projects/light_spec.h"

class QGridLayout;
class QLabel;

namespace ir::widgets {

class ChoiceField;
class ColourField;
class NumberField;
class VectorField;

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
    };
    QWidget* add(const QString& label, QWidget* control, const QString& tip);
    void make_strength_rows();
    void make_place_rows();
    void make_shape_rows();
    NumberField* number_row(const char* name, const QString& label, const QString& tip, double most,
                            const QString& unit, double projects::LightSpec::*member);
    void set_shown(QWidget* control, bool shown);

    QGridLayout* grid_;
    std::vector<FormRow> rows_;
    ChoiceField *type_, *quantity_, *aim_;
    NumberField *amount_, *outer_, *inner_;
    ColourField* colour_;
    VectorField *position_, *target_, *direction_, *size_;
};

}  // namespace ir::widgets
