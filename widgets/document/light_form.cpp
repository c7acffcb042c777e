#include "widgets/document/light_form.h"

#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/document/fields.h"
#include "widgets/document/project_nodes.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::LightSpec;
using Type = LightSpec::Type;
using Quantity = LightSpec::Quantity;

constexpr Quantity quantities[] = {Quantity::intensity, Quantity::flux, Quantity::irradiance,
                                   Quantity::radiance};

QString quantity_name(Quantity quantity) {
    const auto& text = projects::quantity_text(quantity);
    return QStringLiteral("%1, %2").arg(q(text.label), q(text.unit));
}

}  // namespace

LightSpec with_type(const LightSpec& light, Type type) {
    LightSpec changed = light;
    changed.type = type;
    const auto allowed = projects::allowed_quantities(type);
    if (std::find(allowed.begin(), allowed.end(), light.quantity) == allowed.end()) {
        changed.amount = light.intensity();
        changed.quantity = allowed.front();
    }
    if (type == Type::point) changed.target = changed.direction = std::nullopt;
    if (type == Type::directional) {
        changed.direction = light.travel();
        changed.target.reset();
    }
    if (looks(type) && !changed.target && !changed.direction) changed.direction = light.travel();
    return changed;
}

LightSpec with_quantity(const LightSpec& light, Quantity quantity) {
    LightSpec changed = light;
    changed.quantity = quantity;
    if (quantity == light.quantity) return changed;
    changed.amount = light.intensity();
    if (quantity == Quantity::flux) changed.amount *= projects::flux_per_unit(light);
    return changed;
}

LightForm::LightForm(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(8);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(1, 1);
    grid_->setColumnMinimumWidth(0, 64);
    type_ = new ChoiceField("light-type", this);
    add(tr("Type"), type_, tr("Kind of light"));
    connect(type_, &ChoiceField::chosen, this, [this](const QString& id) {
        for (const Type type : LightSpec::types)
            if (id == QString::fromStdString(to_string(type)))
                emit change_wanted(
                    tr("type"), [type](LightSpec& light) { light = with_type(light, type); }, false);
    });
    make_strength_rows();
    make_colour_row(projects::field_of(projects::light_fields(), "color"));
    for (const auto& field : projects::light_fields()) {
        if (field.text.key == "target") make_aim_row();
        if (field.text.key != "color") make_field_row(field);
    }
}

QWidget* LightForm::add(const QString& label, QWidget* control, const QString& tip) {
    rows_.push_back({add_row(grid_, label, control, tip), control, nullptr});
    return control;
}

void LightForm::make_strength_rows() {
    quantity_ = new ChoiceField("light-quantity", this);
    add(tr("Given as"), quantity_,
        tr("Choosing another quantity converts the number; the light stays as bright. What is chosen "
           "stays when cone or size change"));
    connect(quantity_, &ChoiceField::chosen, this, [this](const QString& id) {
        for (const auto quantity : quantities)
            if (id == q(to_string(quantity)))
                emit change_wanted(
                    tr("quantity"), [quantity](LightSpec& light) { light = with_quantity(light, quantity); },
                    false);
    });
    const auto& text = projects::quantity_text(Quantity::intensity);
    amount_ = make_number(QStringLiteral("light-amount"), text, this);
    add(tr("Strength"), amount_, q(text.doc));
    connect(amount_, &NumberField::chosen, this, [this](double value) {
        emit change_wanted(
            tr("strength"), [value](LightSpec& light) { light.amount = value; }, true);
    });
    connect(amount_, &NumberField::editingFinished, this, &LightForm::finished);
}

void LightForm::make_aim_row() {
    aim_ = new ChoiceField("light-aim", this);
    add(tr("Looks"), aim_, tr("At a point, or along a direction"));
    connect(aim_, &ChoiceField::chosen, this, [this](const QString& id) {
        const bool at_point = id == QLatin1String("target");
        emit change_wanted(
            tr("aim"),
            [at_point](LightSpec& light) {
                const glm::dvec3 travel = light.travel();
                light.target = at_point ? std::optional(light.position + travel) : std::nullopt;
                light.direction = at_point ? std::nullopt : std::optional(travel);
            },
            false);
    });
}

void LightForm::make_field_row(const projects::Field<LightSpec>& field) {
    const QString name = QStringLiteral("light-") + q(field.text.key), label = q(field.text.label);
    const auto change = [this, label, &field](int index, double value) {
        emit change_wanted(
            label.toLower(),
            [&field, index, value](LightSpec& light) {
                projects::set_number(field.slot(light), index, value);
            },
            true);
    };
    QWidget* control = nullptr;
    if (std::holds_alternative<double LightSpec::*>(field.member)) {
        auto* number = make_number(name, field.text, this);
        connect(number, &NumberField::chosen, this, [change](double value) { change(0, value); });
        connect(number, &NumberField::editingFinished, this, &LightForm::finished);
        control = number;
    } else {
        const bool is_size = std::holds_alternative<glm::dvec2 LightSpec::*>(field.member);
        auto* vector = new VectorField(
            name, is_size ? QStringList{QStringLiteral("w"), QStringLiteral("h")} : xyz, this);
        vector->set_range(field.text.range);
        connect(vector, &VectorField::chosen, this, change);
        connect(vector, &VectorField::finished, this, &LightForm::finished);
        control = vector;
    }
    add(label, control, q(field.text.doc));
    rows_.back().field = &field;
}

void LightForm::make_colour_row(const projects::Field<LightSpec>& field) {
    colour_ = new ColourField(QStringLiteral("light-") + q(field.text.key), false, field.text.range, this);
    add(q(field.text.label), colour_, q(field.text.doc));
    connect(colour_, &ColourField::chosen, this, [this](const std::vector<double>& c) {
        emit change_wanted(
            tr("colour"),
            [c](LightSpec& light) {
                light.color = {c[0], c[1], c[2]};
            },
            true);
    });
    connect(colour_, &ColourField::finished, this, &LightForm::finished);
}

void LightForm::set_shown(QWidget* control, bool shown) {
    for (const auto& row : rows_) {
        if (row.control != control) continue;
        row.label->setVisible(shown);
        control->setVisible(shown);
    }
}

void LightForm::set_usable(const QString& why_not) {
    for (const auto& row : rows_) ir::widgets::set_usable(row.control, why_not);
}

void LightForm::show_light(const LightSpec& light) {
    std::vector<Option> kinds, strengths;
    for (const Type type : LightSpec::types)
        kinds.push_back({QString::fromStdString(to_string(type)), light_name(type), {}});
    type_->show_options(kinds, QString::fromStdString(to_string(light.type)));
    const auto allowed = projects::allowed_quantities(light.type);
    for (const auto quantity : allowed)
        strengths.push_back({QString::fromStdString(to_string(quantity)), quantity_name(quantity), {}});
    quantity_->show_options(strengths, QString::fromStdString(to_string(light.quantity)));
    amount_->setSuffix(QLatin1Char(' ') + q(projects::quantity_text(light.quantity).unit));
    amount_->show_value(light.amount);
    colour_->show_values(numbers(light.color));
    aim_->show_options({{QStringLiteral("target"), tr("at a point"), {}},
                        {QStringLiteral("direction"), tr("along a direction"), {}}},
                       light.target ? QStringLiteral("target") : QStringLiteral("direction"));
    set_shown(quantity_, allowed.size() > 1);
    set_shown(aim_, looks(light.type));
    auto values = light;
    for (const auto& row : rows_) {
        if (!row.field) continue;
        const bool counts = row.field->counts_in(light);
        set_shown(row.control, counts);
        const auto shown = projects::numbers_of(row.field->slot(values));
        if (!counts || shown.empty()) continue;
        if (auto* number = qobject_cast<NumberField*>(row.control))
            number->show_value(shown.front());
        else
            static_cast<VectorField*>(row.control)->show_values(shown);
    }
}

}  // namespace ir::widgets
