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
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::MaterialOverride;

/// What a glTF file that does not say has [glTF 2.0 §5.19, KHR_materials_ior, KHR_materials_transmission].
const MaterialOverride& gltf_defaults() {
    static const MaterialOverride defaults{{glm::dvec4(1), 1, 1, glm::dvec3(0), 1, 1.5, 0}};
    return defaults;
}

/// The numbers of one member; those of glTF where it is absent.
std::vector<double> numbers_or_defaults(const projects::Field<MaterialOverride>& field,
                                        MaterialOverride values) {
    const auto numbers = projects::numbers_of(field.slot(values));
    auto defaults = gltf_defaults();
    return numbers.empty() ? projects::numbers_of(field.slot(defaults)) : numbers;
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
    pick_ = make_pick_button(tr("The next click in a picture chooses the material"), this);
    pick_->setObjectName(QStringLiteral("pick-material"));
    grid_->addWidget(names_, 0, 0, 1, 2);
    grid_->addWidget(reset_, 0, 2);
    grid_->addWidget(pick_, 1, 0, 1, 3);
    hint_->setWordWrap(true);
    hint_->setForegroundRole(QPalette::PlaceholderText);
    add_wide(grid_, hint_);
    for (const auto& field : projects::material_fields()) add_field(field);
}

QCheckBox* MaterialForm::add_tick(const projects::FieldText& text, QWidget* field) {
    auto* tick = new QCheckBox(q(text.label), this);
    tick->setObjectName(QStringLiteral("tick:") + q(text.key));
    set_tip(tick, tr("%1. Not ticked: as the file has it. Textures multiply it.").arg(q(text.doc)));
    set_tip(field, q(text.doc));
    const int row = grid_->rowCount();
    grid_->addWidget(tick, row, 0);
    grid_->addWidget(field, row, 1, 1, 2);
    return tick;
}

void MaterialForm::add_field(const projects::Field<MaterialOverride>& field) {
    using Numbers = std::vector<double>;
    const QString name = q(field.text.key);
    const bool is_number = std::holds_alternative<std::optional<double> MaterialOverride::*>(field.member),
               has_alpha =
                   std::holds_alternative<std::optional<glm::dvec4> MaterialOverride::*>(field.member);
    auto* number = is_number ? make_number(name, field.text, this) : nullptr;
    auto* colour = is_number ? nullptr : new ColourField(name, has_alpha, field.text.range, this);
    QWidget* control = number ? static_cast<QWidget*>(number) : colour;
    auto* tick = add_tick(field.text, control);
    const auto change = [this, &field](const Numbers& numbers, bool merges) {
        emit change_wanted(
            material_, q(field.text.label).toLower(),
            [&field, numbers](MaterialOverride& changed) {
                for (std::size_t i = 0; i < numbers.size(); ++i)
                    projects::set_number(field.slot(changed), int(i), numbers[i]);
                if (numbers.empty())
                    std::visit(
                        [&](auto member) { changed.*member = std::decay_t<decltype(changed.*member)>(); },
                        field.member);
            },
            merges);
    };
    connect(tick, &QCheckBox::clicked, this, [=](bool on) {
        change(!on ? Numbers() : number ? Numbers{number->value()} : colour->values(), false);
    });
    if (number) {
        connect(number, &NumberField::chosen, this, [=](double value) { change({value}, true); });
        connect(number, &NumberField::editingFinished, this, &MaterialForm::finished);
    } else {
        connect(colour, &ColourField::chosen, this, [=](const Numbers& values) { change(values, true); });
        connect(colour, &ColourField::finished, this, &MaterialForm::finished);
    }
    rows_.push_back(
        {tick, control,
         [&field](MaterialOverride values) { return !projects::numbers_of(field.slot(values)).empty(); },
         [=, &field](const MaterialOverride& values) {
             const auto shown = numbers_or_defaults(field, values);
             number ? number->show_value(shown.front()) : colour->show_values(shown);
         }});
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
