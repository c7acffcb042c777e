#include "widgets/document/light_form.h"

#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <numbers>

#include "widgets/document/fields.h"
#include "widgets/document/project_nodes.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::LightSpec;
using Type = LightSpec::Type;
using Quantity = LightSpec::Quantity;

constexpr Type types[] = {Type::point, Type::spot, Type::directional, Type::rect, Type::disk};
bool looks(Type type) {
    return type == Type::spot || type == Type::rect || type == Type::disk;
}

QString quantity_name(Quantity quantity) {
    switch (quantity) {
        case Quantity::intensity:
            return LightForm::tr("Intensity, W/sr");
        case Quantity::flux:
            return LightForm::tr("Flux, W");
        case Quantity::irradiance:
            return LightForm::tr("Irradiance, W/m²");
        default:
            return LightForm::tr("Radiance, W/(m² sr)");
    }
}

}  // namespace

LightSpec with_type(const LightSpec& light, Type type) {
    LightSpec changed = light;
    changed.type = type;
    const auto allowed = projects::allowed_quantities(type);
    if (std::find(allowed.begin(), allowed.end(), light.quantity) == allowed.end()) {
        if (light.quantity == Quantity::flux) changed = with_quantity(changed, Quantity::intensity);
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
    // Φ = 4π I
    if (light.quantity == Quantity::intensity && quantity == Quantity::flux)
        changed.amount = light.amount * 4 * std::numbers::pi;
    if (light.quantity == Quantity::flux && quantity == Quantity::intensity)
        changed.amount = light.amount / (4 * std::numbers::pi);
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
        for (const Type type : types)
            if (id == QString::fromStdString(to_string(type)))
                emit change_wanted(
                    tr("type"), [type](LightSpec& light) { light = with_type(light, type); }, false);
    });
    make_strength_rows();
    make_place_rows();
    make_shape_rows();
}

QWidget* LightForm::add(const QString& label, QWidget* control, const QString& tip) {
    rows_.push_back({add_row(grid_, label, control, tip), control});
    return control;
}

NumberField* LightForm::number_row(const char* name, const QString& label, const QString& tip, double most,
                                   const QString& unit, double LightSpec::*member) {
    auto* field = make_number(name, 0, most, unit, this);
    add(label, field, tip);
    connect(field, &NumberField::chosen, this, [this, label, member](double value) {
        emit change_wanted(
            label.toLower(), [member, value](LightSpec& light) { light.*member = value; }, true);
    });
    connect(field, &NumberField::editingFinished, this, &LightForm::finished);
    return field;
}

void LightForm::make_strength_rows() {
    quantity_ = new ChoiceField("light-quantity", this);
    add(tr("Given as"), quantity_,
        tr("Choosing another quantity converts the number; the light stays as bright"));
    connect(quantity_, &ChoiceField::chosen, this, [this](const QString& id) {
        for (const auto quantity : {Quantity::intensity, Quantity::flux})
            if (id == QString::fromStdString(to_string(quantity)))
                emit change_wanted(
                    tr("quantity"), [quantity](LightSpec& light) { light = with_quantity(light, quantity); },
                    false);
    });
    amount_ = number_row("light-amount", tr("Strength"), tr("Per colour channel, times the colour"), 1e300,
                         QStringLiteral("W/sr"), &LightSpec::amount);
    colour_ = new ColourField("light-colour", false, this);
    add(tr("Colour"), colour_, tr("Linear red, green and blue; may be brighter than 1"));
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

void LightForm::make_place_rows() {
    const auto vector = [this](const char* name, const QString& label, const QString& tip, auto put) {
        auto* field = new VectorField(name, xyz, this);
        add(label, field, tip);
        connect(field, &VectorField::chosen, this, [this, label, put](int index, double value) {
            emit change_wanted(
                label.toLower(), [=](LightSpec& light) { put(light)[index] = value; }, true);
        });
        connect(field, &VectorField::finished, this, &LightForm::finished);
        return field;
    };
    position_ = vector("light-position", tr("Position"), tr("x, y, z in metres, world space"),
                       [](LightSpec& light) -> glm::dvec3& { return light.position; });
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
    target_ = vector("light-target", tr("Target"), tr("Point that the light looks at: x, y, z in metres"),
                     [](LightSpec& light) -> glm::dvec3& {
                         if (!light.target) light.target = light.position + light.travel();
                         return *light.target;
                     });
    direction_ = vector("light-direction", tr("Direction"),
                        tr("Direction in which the light travels: x, y, z, any length"),
                        [](LightSpec& light) -> glm::dvec3& {
                            if (!light.direction) light.direction = light.travel();
                            return *light.direction;
                        });
}

void LightForm::make_shape_rows() {
    outer_ = number_row("light-outer", tr("Outer"), tr("Half-angle in degrees where the light ends"), 90,
                        QStringLiteral("°"), &LightSpec::outer);
    inner_ = number_row("light-inner", tr("Inner"),
                        tr("Half-angle up to which the light is full; equal to the outer: a hard edge"), 90,
                        QStringLiteral("°"), &LightSpec::inner);
    size_ = new VectorField("light-size", {QStringLiteral("w"), QStringLiteral("h")}, this);
    add(tr("Size"), size_, tr("Sides of the rectangle or diameters of the disk, metres"));
    connect(size_, &VectorField::chosen, this, [this](int index, double value) {
        emit change_wanted(
            tr("size"), [=](LightSpec& light) { light.size[index] = value; }, true);
    });
    connect(size_, &VectorField::finished, this, &LightForm::finished);
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
    std::vector<Option> kinds, quantities;
    for (const Type type : types)
        kinds.push_back({QString::fromStdString(to_string(type)), light_name(type), {}});
    type_->show_options(kinds, QString::fromStdString(to_string(light.type)));
    const auto allowed = projects::allowed_quantities(light.type);
    for (const auto quantity : allowed)
        quantities.push_back({QString::fromStdString(to_string(quantity)), quantity_name(quantity), {}});
    quantity_->show_options(quantities, QString::fromStdString(to_string(light.quantity)));
    amount_->setSuffix(QLatin1Char(' ') + unit_of(light.quantity));
    amount_->show_value(light.amount);
    colour_->show_values(numbers(light.color));
    position_->show_values(numbers(light.position));
    aim_->show_options({{QStringLiteral("target"), tr("at a point"), {}},
                        {QStringLiteral("direction"), tr("along a direction"), {}}},
                       light.target ? QStringLiteral("target") : QStringLiteral("direction"));
    target_->show_values(numbers(light.target.value_or(glm::dvec3(0))));
    direction_->show_values(numbers(light.direction.value_or(glm::dvec3(0, -1, 0))));
    outer_->show_value(light.outer);
    inner_->show_value(light.inner);
    size_->show_values({light.size.x, light.size.y});
    const bool has_size = light.type == Type::rect || light.type == Type::disk;
    set_shown(quantity_, allowed.size() > 1);
    set_shown(position_, light.type != Type::directional);
    set_shown(aim_, looks(light.type));
    set_shown(target_, looks(light.type) && light.target.has_value());
    set_shown(direction_, light.type == Type::directional || (looks(light.type) && !light.target));
    set_shown(outer_, light.type == Type::spot);
    set_shown(inner_, light.type == Type::spot);
    set_shown(size_, has_size);
}

}  // namespace ir::widgets
