#include "widgets/document/analysis_editor.h"

#include <QGridLayout>
#include <QLabel>

#include "projects/analyses.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/experiment_checks.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Analysis;

const projects::Field<Analysis>& analysis_field(const char* key) {
    return projects::field_of(projects::analysis_fields(), key);
}

std::vector<std::string> keys_in(const QString& text) {
    std::vector<std::string> keys;
    for (const auto& word : text.split(QLatin1Char(','), Qt::SkipEmptyParts))
        if (const auto key = word.trimmed(); !key.isEmpty()) keys.push_back(key.toStdString());
    return keys;
}

/// Images of the method that is asked about; others of its buffers are shown as they are called.
std::vector<Option> output_options(const ShownProject& shown, const Analysis& analysis) {
    std::vector<Option> options{{QString(), QObject::tr("Main result"), {}}};
    const auto* experiment = analysis.experiments.empty()
                                 ? nullptr
                                 : projects::find_item(shown.project.experiments, analysis.experiments[0]);
    const auto* method = experiment ? shown.registry.find(experiment->method) : nullptr;
    if (!method) return options;
    for (const auto& output : method->outputs)
        if (output.kind == OutputKind::image || output.kind == OutputKind::pyramid ||
            output.kind == OutputKind::stack)
            options.push_back({q(output.key), q(output.label), q(output.doc)});
    return options;
}

std::vector<Option> kind_options() {
    std::vector<Option> options;
    for (const auto& kind : projects::analysis_kinds())
        options.push_back({q(kind.key), q(kind.label), q(kind.doc)});
    return options;
}

}  // namespace

AnalysisEditor::AnalysisEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Analysis"), this);
    name_ = name_row(grid, ItemKind::analysis, tr("What the analysis is called"));
    kind_ = choice_row(grid, "kind");
    doc_ = new QLabel(this);
    doc_->setWordWrap(true);
    add_wide(grid, doc_);
    experiments_ = new ExperimentChecks(tr("Experiments of the analysis"), this);
    row(grid, analysis_field("experiments").text, experiments_);
    connect(experiments_, &ExperimentChecks::ticked, this, [this](const QString& id, bool is_in) {
        emit edit_wanted(field_edit<Analysis>(
            id_, "experiments",
            [chosen = id.toStdString(), is_in](Analysis& analysis) {
                std::erase(analysis.experiments, chosen);
                if (is_in) analysis.experiments.push_back(chosen);
            },
            false));
    });
    reference_ = choice_row(grid, "reference");
    parameters_ = new TextField("parameters", this);
    row(grid, analysis_field("parameters").text, parameters_);
    connect(parameters_, &TextField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<Analysis>(
            id_, "parameters", [keys = keys_in(text)](Analysis& analysis) { analysis.parameters = keys; },
            false));
    });
    output_ = choice_row(grid, "output");
    frames_ = make_number(QStringLiteral("frames"), analysis_field("frames").text, this);
    frames_->set_whole(true);
    row(grid, analysis_field("frames").text, frames_);
    connect(frames_, &NumberField::chosen, this, [this](double frames) {
        emit edit_wanted(field_edit<Analysis>(
            id_, "frames", [frames](Analysis& analysis) { analysis.frames = int(frames); }));
    });
    problem_ = new QLabel(this);
    problem_->setObjectName(QStringLiteral("analysis-problem"));
    problem_->setWordWrap(true);
    add_wide(grid, problem_);
    notes_ = new NotesField("notes", this);
    row(grid, analysis_field("notes").text, notes_);
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<Analysis>(
            id_, "notes", [notes = text.toStdString()](Analysis& analysis) { analysis.notes = notes; }));
    });
}

ChoiceField* AnalysisEditor::choice_row(QGridLayout* grid, const char* key) {
    auto* choice = new ChoiceField(key, this);
    row(grid, analysis_field(key).text, choice);
    const auto member = std::get<std::string Analysis::*>(analysis_field(key).member);
    connect(choice, &ChoiceField::chosen, this, [this, key, member](const QString& chosen) {
        emit edit_wanted(field_edit<Analysis>(
            id_, key,
            [member, value = chosen.toStdString()](Analysis& analysis) { analysis.*member = value; }, false));
    });
    return choice;
}

void AnalysisEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    const auto& analysis = *projects::find_item(shown.project.analyses, id_);
    set_controls_usable(shown.read_only ? shown.why_read_only : QString());
    name_->show_text(q(analysis.name));
    kind_->show_options(kind_options(), q(analysis.kind));
    const auto* kind = projects::find_analysis_kind(analysis.kind);
    doc_->setText(kind ? q(kind->doc) : QString());
    experiments_->show_experiments(shown.project, analysis.experiments);
    reference_->show_options(with_first({QString(), tr("None"), {}}, picture_options(shown.project)),
                             q(analysis.reference));
    QStringList keys;
    for (const auto& key : analysis.parameters) keys << q(key);
    parameters_->show_text(keys.join(QStringLiteral(", ")));
    const bool compares = kind && kind->compares_machines;
    const auto& machines = projects::default_machines;
    parameters_->setPlaceholderText(compares ? QStringLiteral("%1, %2").arg(machines[0], machines[1])
                                             : tr("all"));
    if (!shown.read_only) {
        const bool takes = !kind || kind->takes_parameters || compares;
        set_usable(parameters_, takes ? QString() : tr("This question takes no parameters."));
        const bool judges = !compares || !analysis.reference.empty();  // what is wrong can be taken out
        set_usable(reference_, judges ? QString() : tr("This question takes no reference."));
        const auto why_no_frames =
            !kind || kind->takes_frames ? QString() : tr("This question is not about frames.");
        set_usable(output_, why_no_frames);
        set_usable(frames_, why_no_frames);
    }
    output_->show_options(output_options(shown, analysis), q(analysis.output));
    frames_->show_value(analysis.frames);
    const auto why_not = projects::why_not_analysed(shown.project, analysis, shown.registry);
    problem_->setText(why_not.empty() ? tr("The Analyses panel carries it out.")
                                      : tr("It cannot be carried out: %1.").arg(q(why_not)));
    notes_->show_text(q(analysis.notes));
}

}  // namespace ir::widgets
