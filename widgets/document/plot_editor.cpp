#include "widgets/document/plot_editor.h"

#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <algorithm>

#include "projects/plots.h"
#include "renderers/image/metrics.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/field_edit.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"

namespace ir::widgets {
namespace {

using projects::ErrorPlot;

QString q(const std::string& text) {
    return QString::fromStdString(text);
}

std::vector<Option> pictures(const projects::Project& project) {
    auto options = named_options(project.experiments);
    for (const auto& image : project.images)
        options.push_back({q(image.id), QObject::tr("%1 (image)").arg(q(image.name)), q(image.source)});
    return options;
}

/// Frames, the seed, and the parameters of the experiments' methods, as these call them.
std::vector<Option> key_options(const ShownProject& shown, const ErrorPlot& plot) {
    std::vector<Option> options;
    for (const auto& key : projects::plot_keys(shown.project, plot, shown.registry)) {
        Option option{q(key), q(key), {}};
        if (key == "frames") option = {q(key), QObject::tr("Frames"), QObject::tr("Accumulated frames")};
        if (key == "seed") option = {q(key), QObject::tr("Seed"), QObject::tr("Of all random numbers")};
        for (const auto& id : plot.experiments) {
            const auto* experiment = projects::find_item(shown.project.experiments, id);
            const auto* method = experiment ? shown.registry.find(experiment->method) : nullptr;
            const auto* parameter = method ? ir::find(method->parameters, key) : nullptr;
            if (parameter) option = {q(key), q(parameter->label), q(parameter->doc)};
        }
        options.push_back(option);
    }
    return options;
}

std::vector<Option> metric_options() {
    std::vector<Option> options;
    for (const auto& metric : metrics()) options.push_back({q(metric.name), q(metric.label), q(metric.doc)});
    return options;
}

QString values_text(const ErrorPlot& plot) {
    projects::Sweep::Axis axis;
    axis.key = plot.over;
    axis.values = plot.values;
    return q(axis_text(axis));
}

}  // namespace

PlotEditor::PlotEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Plot of the error"), this);
    name_ = name_row(grid, ItemKind::plot, tr("What the plot is called"));
    reference_ =
        choice_row(grid, "reference", tr("Reference"),
                   tr("Experiment or foreign image that all others are judged by"), &ErrorPlot::reference);
    make_experiments(grid);
    make_values(grid);
    metric_ = choice_row(grid, "metric", tr("Metric"),
                         tr("Error that is drawn; all metrics are measured, so that changing it is free"),
                         &ErrorPlot::metric);
    axis_ = new ChoiceField("axis", this);
    row(grid, tr("Drawn over"), axis_, tr("Horizontal axis: the time that rendering took, or the values"));
    connect(axis_, &ChoiceField::chosen, this, [this](const QString& id) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, "axis",
            [against_time = id == QLatin1String("time")](ErrorPlot& plot) {
                plot.against_time = against_time;
            },
            false));
    });
    notes_ = new NotesField("notes", this);
    row(grid, tr("Notes"), notes_, tr("What the plot shows"));
    connect(notes_, &NotesField::chosen, this, [this](const QString& text) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, "notes", [notes = text.toStdString()](ErrorPlot& plot) { plot.notes = notes; }));
    });
}

ChoiceField* PlotEditor::choice_row(QGridLayout* grid, const char* name, const QString& label,
                                    const QString& tip, std::string ErrorPlot::*member) {
    auto* field = new ChoiceField(name, this);
    row(grid, label, field, tip);
    connect(field, &ChoiceField::chosen, this, [this, name, member](const QString& chosen) {
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, name, [member, value = chosen.toStdString()](ErrorPlot& plot) { plot.*member = value; },
            false));
    });
    return field;
}

void PlotEditor::make_experiments(QGridLayout* grid) {
    experiments_ = new QListWidget(this);
    experiments_->setObjectName(QStringLiteral("experiments"));
    experiments_->setAccessibleName(tr("Experiments of the plot"));
    experiments_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    experiments_->setTextElideMode(Qt::ElideRight);
    row(grid, tr("Experiments"), experiments_, tr("Those that are drawn; Space adds or removes one"));
    connect(experiments_, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (showing_) return;
        const auto chosen = item->data(Qt::UserRole).toString().toStdString();
        const bool is_in = item->checkState() == Qt::Checked;
        emit edit_wanted(field_edit<ErrorPlot>(
            id_, "experiments",
            [chosen, is_in](ErrorPlot& plot) {
                std::erase(plot.experiments, chosen);
                if (is_in) plot.experiments.push_back(chosen);
            },
            false));
    });
}

void PlotEditor::make_values(QGridLayout* grid) {
    over_ = new ChoiceField("over", this);
    row(grid, tr("Varies"), over_, tr("What differs from point to point"));
    connect(over_, &ChoiceField::chosen, this, &PlotEditor::choose_key);
    values_ = new TextField("values", this);
    row(grid, tr("Values"), values_,
        tr("Separated by commas: 32, 64, 128. Of frames they may be left out: then 1, 2, 4, … of each "
           "experiment"));
    connect(values_, &TextField::chosen, this, [this](const QString& text) {
        emit edit_wanted([id = id_, text = text.toStdString()](const projects::Project& project) {
            const auto& plot = projects::edits::item_of<ErrorPlot>(project, id);
            auto values = text.empty() ? std::vector<projects::Json>() : parse_axis(plot.over, text);
            return field_edit<ErrorPlot>(
                id, "values", [values = std::move(values)](ErrorPlot& changed) { changed.values = values; },
                false)(project);
        });
    });
    count_ = new QLabel(this);
    count_->setObjectName(QStringLiteral("plot-count"));
    count_->setWordWrap(true);
    add_wide(grid, count_);
}

void PlotEditor::choose_key(const QString& key) {
    // The old key's values mean nothing here: it begins with what the first experiment has.
    const auto value = present_value(first_, key.toStdString());
    emit edit_wanted(field_edit<ErrorPlot>(
        id_, "key",
        [key = key.toStdString(), value](ErrorPlot& plot) {
            plot.over = key;
            plot.values.clear();
            if (key != "frames" && !value.is_null()) plot.values.push_back(value);
        },
        false));
}

void PlotEditor::show_experiments(const ShownProject& shown) {
    const auto is_in = [&](const std::string& id) {
        return std::find(plot_.experiments.begin(), plot_.experiments.end(), id) != plot_.experiments.end();
    };
    const int current = experiments_->currentRow();
    experiments_->clear();
    const auto add = [&](const std::string& id, const QString& label, bool is_checked) {
        auto* item = new QListWidgetItem(label, experiments_);
        item->setData(Qt::UserRole, q(id));
        item->setToolTip(q(id));
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(is_checked ? Qt::Checked : Qt::Unchecked);
    };
    for (const auto& experiment : shown.project.experiments)
        add(experiment.id, q(experiment.name), is_in(experiment.id));
    for (const auto& id : plot_.experiments)
        if (!projects::find_item(shown.project.experiments, id))
            add(id, tr("%1 (not in the project)").arg(q(id)), true);
    experiments_->setCurrentRow(std::clamp(current, -1, experiments_->count() - 1));
    const int line = experiments_->fontMetrics().lineSpacing() + 6;
    experiments_->setFixedHeight(std::clamp(experiments_->count(), 2, 6) * line + 4);
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
    showing_ = true;
    id_ = item.id.toStdString();
    plot_ = *projects::find_item(shown.project.plots, id_);
    first_ = {};
    for (const auto& id : plot_.experiments)
        if (const auto* experiment = projects::find_item(shown.project.experiments, id)) {
            first_ = projects::effective(*experiment);
            break;
        }
    set_controls_usable(shown.read_only ? shown.why_read_only : QString());
    name_->show_text(q(plot_.name));
    reference_->show_options(with_first({QString(), tr("None"), {}}, pictures(shown.project)),
                             q(plot_.reference));
    show_experiments(shown);
    over_->show_options(key_options(shown, plot_), q(plot_.over));
    values_->setPlaceholderText(plot_.over == "frames" ? tr("1, 2, 4, …") : QString());
    values_->show_text(values_text(plot_));
    metric_->show_options(metric_options(), q(plot_.metric));
    axis_->show_options({{QStringLiteral("time"), tr("Time"), tr("Milliseconds of rendering")},
                         {QStringLiteral("values"), tr("Values"), tr("What varies")}},
                        plot_.against_time ? QStringLiteral("time") : QStringLiteral("values"));
    show_count(shown);
    notes_->show_text(q(plot_.notes));
    showing_ = false;
}

}  // namespace ir::widgets
