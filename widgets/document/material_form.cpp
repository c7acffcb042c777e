#include "widgets/document/material_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCompleter>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QToolButton>
#include <algorithm>

#include "widgets/document/fields.h"

namespace ir::widgets {
namespace {

using projects::MaterialOverride;

template <class Vector>
std::vector<double> numbers(const Vector& v) {
    std::vector<double> result;
    for (int i = 0; i < Vector::length(); ++i) result.push_back(v[i]);
    return result;
}

}  // namespace

MaterialForm::MaterialForm(QWidget* parent)
    : QWidget(parent), names_(new QComboBox(this)), hint_(new QLabel(this)), grid_(new QGridLayout(this)) {
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(8);
    grid_->setVerticalSpacing(4);
    grid_->setColumnStretch(1, 1);
    names_->setObjectName(QStringLiteral("material"));
    names_->setAccessibleName(tr("Material"));
    names_->setEditable(true);
    names_->setInsertPolicy(QComboBox::NoInsert);
    names_->setMinimumContentsLength(8);
    names_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    names_->completer()->setFilterMode(Qt::MatchContains);
    names_->completer()->setCompletionMode(QCompleter::PopupCompletion);
    names_->lineEdit()->setPlaceholderText(tr("Name of a material"));
    set_tip(names_, tr("A material of the file; type to search. Changed ones are marked with •"));
    connect(names_, &QComboBox::activated, this,
            [this](int index) { show_material(names_->itemData(index).toString()); });
    connect(names_->lineEdit(), &QLineEdit::editingFinished, this, [this] {
        const int index = names_->findText(names_->currentText());
        show_material(index >= 0 ? names_->itemData(index).toString() : names_->currentText());
    });
    reset_ = make_button("reset", tr("Leave this material as the file has it"), this);
    reset_->setObjectName(QStringLiteral("reset-material"));
    connect(reset_, &QToolButton::clicked, this, [this] {
        emit change_wanted(
            material_, tr("values"), [](MaterialOverride& change) { change = {}; }, false);
    });
    grid_->addWidget(names_, 0, 0, 1, 2);
    grid_->addWidget(reset_, 0, 2);
    hint_->setWordWrap(true);
    hint_->setForegroundRole(QPalette::PlaceholderText);
    add_wide(grid_, hint_);
    add_colour("base_colour", tr("Colour"),
               tr("Base colour factor: linear red, green, blue and opacity, 0 … 1"), 1, glm::dvec4(1),
               &MaterialOverride::base_colour);
    add_number("metallic", tr("Metallic"), tr("0: dielectric, 1: metal"), 0, 1, 1,
               &MaterialOverride::metallic);
    add_number("roughness", tr("Roughness"), tr("0: mirror-like, 1: fully rough"), 0, 1, 1,
               &MaterialOverride::roughness);
    add_colour("emission", tr("Emission"), tr("Radiance that it emits: red, green, blue in W/(m² sr)"), 1e9,
               glm::dvec3(0), &MaterialOverride::emission);
    add_number("normal_scale", tr("Bumps"), tr("Strength of the normal map; 0: none"), -100, 100, 1,
               &MaterialOverride::normal_scale);
    add_number("ior", tr("IOR"), tr("Index of refraction, 1 … 10"), 1, 10, 1.5, &MaterialOverride::ior);
    add_number("transmission", tr("Transmission"), tr("0: opaque, 1: glass"), 0, 1, 0,
               &MaterialOverride::transmission);
}

QCheckBox* MaterialForm::add_tick(const char* name, const QString& label, const QString& tip,
                                  QWidget* field) {
    auto* tick = new QCheckBox(label, this);
    tick->setObjectName(QStringLiteral("tick:") + QLatin1String(name));
    set_tip(tick, tr("%1. Not ticked: as the file has it. Textures multiply it.").arg(tip));
    set_tip(field, tip);
    const int row = grid_->rowCount();
    grid_->addWidget(tick, row, 0);
    grid_->addWidget(field, row, 1, 1, 2);
    return tick;
}

void MaterialForm::add_number(const char* name, const QString& label, const QString& tip, double least,
                              double most, double standard, std::optional<double> MaterialOverride::*member) {
    auto* field = make_number(name, least, most, {}, this);
    auto* tick = add_tick(name, label, tip, field);
    connect(tick, &QCheckBox::clicked, this, [=, this](bool on) {
        const double start = field->value();
        emit change_wanted(
            material_, label.toLower(),
            [=](MaterialOverride& change) { change.*member = on ? std::optional(start) : std::nullopt; },
            false);
    });
    connect(field, &NumberField::chosen, this, [=, this](double value) {
        emit change_wanted(
            material_, label.toLower(), [=](MaterialOverride& change) { change.*member = value; }, true);
    });
    connect(field, &NumberField::editingFinished, this, &MaterialForm::finished);
    rows_.push_back({tick, field, [member](const auto& values) { return (values.*member).has_value(); },
                     [=](const auto& values) { field->show_value((values.*member).value_or(standard)); }});
}

template <class Vector>
void MaterialForm::add_colour(const char* name, const QString& label, const QString& tip, double most,
                              Vector standard, std::optional<Vector> MaterialOverride::*member) {
    auto* field = new ColourField(name, Vector::length() == 4, this);
    field->set_range(0, most);
    auto* tick = add_tick(name, label, tip, field);
    const auto put = [member](MaterialOverride& change, const std::vector<double>& values) {
        Vector vector(0.0);
        for (int i = 0; i < Vector::length(); ++i) vector[i] = values[std::size_t(i)];
        change.*member = vector;
    };
    connect(tick, &QCheckBox::clicked, this, [=, this](bool on) {
        const std::vector<double> start = field->values();
        emit change_wanted(
            material_, label.toLower(),
            [=](MaterialOverride& change) { on ? put(change, start) : (change.*member).reset(); }, false);
    });
    connect(field, &ColourField::chosen, this, [=, this](const std::vector<double>& values) {
        emit change_wanted(
            material_, label.toLower(), [=](MaterialOverride& change) { put(change, values); }, true);
    });
    connect(field, &ColourField::finished, this, &MaterialForm::finished);
    rows_.push_back(
        {tick, field, [member](const auto& values) { return (values.*member).has_value(); },
         [=](const auto& values) { field->show_values(numbers((values.*member).value_or(standard))); }});
}

void MaterialForm::set_usable(const QString& why_not) {
    why_not_ = why_not;
}

void MaterialForm::fill_names() {
    QStringList names;
    for (const auto& material : known_) names << material.name;
    for (const auto& [name, change] : overrides_)
        if (!names.contains(QString::fromStdString(name))) names << QString::fromStdString(name);
    if (!material_.isEmpty() && !names.contains(material_)) names << material_;
    const QSignalBlocker quiet(names_);
    const bool same = names_->count() == names.size();
    if (!same) names_->clear();
    for (int i = 0; i < names.size(); ++i) {
        const bool changed = overrides_.count(names[i].toStdString()) != 0;
        const QString text = changed ? QStringLiteral("• ") + names[i] : names[i];
        same ? names_->setItemText(i, text) : names_->addItem(text);
        names_->setItemData(i, names[i]);
    }
    if (material_.isEmpty() && !names.isEmpty()) material_ = names.front();
    names_->setCurrentIndex(names_->findData(material_));
}

void MaterialForm::show_materials(const Overrides& overrides, const std::vector<MaterialFacts>& known) {
    overrides_ = overrides;
    known_ = known;
    const auto is_known = [&](const MaterialFacts& each) { return each.name == material_; };
    const bool listed = std::any_of(known.begin(), known.end(), is_known);
    if (!listed && !known.empty() && overrides.count(material_.toStdString()) == 0) material_.clear();
    fill_names();
    show_values();
}

void MaterialForm::show_material(const QString& name) {
    if (name == material_) return;
    material_ = name;
    fill_names();
    show_values();
}

void MaterialForm::show_values() {
    const auto found = overrides_.find(material_.toStdString());
    const bool is_changed = found != overrides_.end();
    const MaterialOverride change = is_changed ? found->second : MaterialOverride();
    const auto fact = std::find_if(known_.begin(), known_.end(),
                                   [&](const MaterialFacts& each) { return each.name == material_; });
    const MaterialOverride file = fact == known_.end() ? MaterialOverride() : fact->values;
    hint_->setVisible(known_.empty());
    hint_->setText(tr("The file's materials are listed once it is loaded; a name may also be typed."));
    const QString none = material_.isEmpty() ? tr("Choose a material first.") : QString();
    const QString why_not = why_not_.isEmpty() ? none : why_not_;
    for (const auto& row : rows_) {
        const bool ticked = row.has(change);
        row.tick->setChecked(ticked);
        row.show(ticked ? change : file);
        // A number that nobody knows is not shown.
        QSizePolicy policy = row.field->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        row.field->setSizePolicy(policy);
        row.field->setVisible(ticked || row.has(file));
        ir::widgets::set_usable(row.tick, why_not);
        ir::widgets::set_usable(row.field, !why_not.isEmpty() ? why_not
                                           : ticked           ? QString()
                                                    : tr("As the file has it; tick it to change it."));
    }
    ir::widgets::set_usable(reset_, !why_not.isEmpty() ? why_not
                                    : is_changed       ? QString()
                                                       : tr("It is as the file has it."));
}

}  // namespace ir::widgets
