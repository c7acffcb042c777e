#include "widgets/document/plot_editor.h"

#include <QGridLayout>
#include <QLabel>
#include <algorithm>

#include "projects/plots.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/experiment_checks.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"
#include "widgets/document/plot_options.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::ErrorPlot;

const projects::FieldText& text_of(const char* key) {
    return projects::field_of(projects::plot_fields(), key).text;
}

}  // namespace

PlotEditor::PlotEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Plot of the error"), this);
    name_ = name_row(grid, ItemKind::plot, tr("What the plot is called"));
    reference_ = choice_row(grid, "reference");
    make_experiments(grid);
    make_values(grid);
    metric_ = choice_row(grid, "metric");
    axis_ = new ChoiceField("axis", this);
    row(grid, text_of("axis"), axis_);
    connect(axis_, &ChoiceField::chosen, this,
            [this](const QString& id) { emit edit_wanted(set_plot_axis(id_, id == QLatin1String("time"))); });
    notes_ = new NotesField("notes", this);
    row(grid, text_of("notes"), notes_);
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, "notes", [notes = text.toStdString()](ErrorPlot& plot) { plot.notes = notes; }));
    });
}

ChoiceField* PlotEditor::choice_row(QGridLayout* grid, const char* key) {
    auto* field = new ChoiceField(key, this);
    row(grid, text_of(key), field);
    const auto member =
        std::get<std::string ErrorPlot::*>(projects::field_of(projects::plot_fields(), key).member);
    connect(field, &ChoiceField::chosen, this, [this, key, member](const QString& chosen) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, key, [member, value = chosen.toStdString()](ErrorPlot& plot) { plot.*member = value; },
            false));
    });
    return field;
}

void PlotEditor::make_experiments(QGridLayout* grid) {
    experiments_ = new ExperimentChecks(tr("Experiments of the plot"), this);
    row(grid, text_of("experiments"), experiments_);
    connect(experiments_, &ExperimentChecks::ticked, this, [this](const QString& id, bool is_in) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, "experiments",
            [chosen = id.toStdString(), is_in](ErrorPlot& plot) {
                std::erase(plot.experiments, chosen);
                if (is_in) plot.experiments.push_back(chosen);
            },
            false));
    });
}

void PlotEditor::make_values(QGridLayout* grid) {
    over_ = new ChoiceField("over", this);
    row(grid, text_of("over"), over_);
    connect(over_, &ChoiceField::chosen, this,
            [this](const QString& key) { emit edit_wanted(set_plot_key(id_, key.toStdString())); });
    values_ = new TextField("values", this);
    row(grid, text_of("values"), values_);
    connect(values_, &TextField::chosen, this,
            [this](const QString& text) { emit edit_wanted(set_plot_values(id_, text.toStdString())); });
    count_ = new QLabel(this);
    count_->setObjectName(QStringLiteral("plot-count"));
    count_->setWordWrap(true);
    add_wide(grid, count_);
}

void PlotEditor::show_count(const ShownProject& shown) {
    const auto count = projects::count_points(shown.project, plot_);
    if (plot_.experiments.empty())
        count_->setText(tr("Choose experiments to be judged."));
    else if (plot_.reference.empty())
        count_->setText(tr("Choose what they are judged by."));
    else if (count == 0)
        count_->setText(tr("Give values to measure at."));
    else
        count_->setText(count == 1 ? tr("1 point") : tr("%1 points").arg(count));
}

void PlotEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    id_ = item.id.toStdString();
    plot_ = *projects::find_item(shown.project.plots, id_);
    set_controls_usable(shown.read_only ? shown.why_read_only : QString());
    name_->show_text(q(plot_.name));
    reference_->show_options(with_first({QString(), tr("None"), {}}, picture_options(shown.project)),
                             q(plot_.reference));
    experiments_->show_experiments(shown.project, plot_.experiments);
    over_->show_options(plot_key_options(shown.project, plot_, shown.registry), q(plot_.over));
    values_->setPlaceholderText(plot_values_hint(plot_));
    values_->show_text(plot_values_text(plot_));
    metric_->show_options(metric_options(), q(plot_.metric));
    axis_->show_options({{QStringLiteral("time"), tr("Time"), tr("Milliseconds of rendering")},
                         {QStringLiteral("values"), tr("Values"), tr("What varies")}},
                        plot_.against_time ? QStringLiteral("time") : QStringLiteral("values"));
    show_count(shown);
    notes_->show_text(q(plot_.notes));
}

}  // namespace ir::widgets
