#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>

#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"
#include "widgets/document/plain_editors.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Comparison;

/// Outputs of the method of A; those of a foreign image are not known.
std::vector<Option> outputs(const ShownProject& shown, const Comparison& comparison) {
    std::vector<Option> options{{QString(), QObject::tr("Main result"), {}}};
    const auto* experiment = projects::find_item(shown.project.experiments, comparison.a);
    const auto* method = experiment ? shown.registry.find(experiment->method) : nullptr;
    if (!method) return options;
    for (const auto& output : method->outputs)
        options.push_back({q(output.key), q(output.label), q(output.doc)});
    return options;
}

}  // namespace

ComparisonEditor::ComparisonEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Comparison"), this);
    name_ = name_row(grid, ItemKind::comparison, tr("What the comparison is called"));
    a_ = choice_row(grid, "a");
    b_ = choice_row(grid, "b");
    output_ = choice_row(grid, "output");
    mode_ = choice_row(grid, "mode");
    make_range_rows(grid);
    notes_ = new NotesField("notes", this);
    row(grid, projects::field_of(projects::comparison_fields(), "notes").text, notes_);
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<Comparison>(
            id_, "notes", [notes = text.toStdString()](Comparison& changed) { changed.notes = notes; }));
    });
}

ChoiceField* ComparisonEditor::choice_row(QGridLayout* grid, const char* key) {
    const auto& text_field = projects::field_of(projects::comparison_fields(), key);
    auto* field = new ChoiceField(key, this);
    row(grid, text_field.text, field);
    const auto member = std::get<std::string Comparison::*>(text_field.member);
    connect(field, &ChoiceField::chosen, this, [this, key, member](const QString& chosen) {
        emit edit_wanted(field_edit<Comparison>(
            id_, key,
            [member, value = chosen.toStdString()](Comparison& changed) { changed.*member = value; }, false));
    });
    return field;
}

void ComparisonEditor::make_range_rows(QGridLayout* grid) {
    automatic_ = new QCheckBox(tr("automatic"), this);
    automatic_->setObjectName(QStringLiteral("automatic-range"));
    row(grid, tr("Range"), automatic_, tr("Values that are shown: chosen from the picture, or from … to"));
    connect(automatic_, &QCheckBox::clicked, this, [this](bool on) {
        emit edit_wanted(field_edit<Comparison>(
            id_, "range",
            [on](Comparison& changed) {
                changed.range = on ? std::nullopt : std::optional(glm::dvec2(0, 1));
            },
            false));
    });
    range_ = new VectorField(QStringLiteral("range"), {QStringLiteral("from"), QStringLiteral("to")}, this);
    row(grid, QString(), range_, q(projects::field_of(projects::comparison_fields(), "range").text.doc));
    connect(range_, &VectorField::chosen, this, [this](int index, double value) {
        emit edit_wanted(field_edit<Comparison>(id_, "range", [=](Comparison& changed) {
            glm::dvec2 range = changed.range.value_or(glm::dvec2(0, 1));
            range[index] = value;
            changed.range = range;
        }));
    });
}

void ComparisonEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    const auto& comparison = *projects::find_item(shown.project.comparisons, id_);
    set_controls_usable(shown.read_only ? shown.why_read_only : QString());
    name_->show_text(q(comparison.name));
    a_->show_options(picture_options(shown.project), q(comparison.a));
    b_->show_options(picture_options(shown.project), q(comparison.b));
    output_->show_options(outputs(shown, comparison), q(comparison.output));
    mode_->show_options(modes_, q(comparison.mode));
    automatic_->setChecked(!comparison.range);
    const glm::dvec2 range = comparison.range.value_or(glm::dvec2(0, 1));
    range_->show_values({range.x, range.y});
    if (!comparison.range && !shown.read_only)
        set_usable(range_, tr("The range is chosen from the picture."));
    notes_->show_text(q(comparison.notes));
}

}  // namespace ir::widgets
