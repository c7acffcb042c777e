#include "widgets/document/plot_options.h"

#include <QObject>

#include "projects/plots.h"
#include "renderers/image/metrics.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::ErrorPlot;

}  // namespace

std::vector<Option> plot_key_options(const projects::Project& project, const ErrorPlot& plot,
                                     const Registry& registry) {
    std::vector<Option> options;
    for (const auto& key : projects::plot_keys(project, plot, registry)) {
        Option option{q(key), q(key), {}};
        if (key == "frames") option = {q(key), QObject::tr("Frames"), QObject::tr("Accumulated frames")};
        if (key == "seed") option = {q(key), QObject::tr("Seed"), QObject::tr("Of all random numbers")};
        for (const auto& id : plot.experiments) {
            const auto* experiment = projects::find_item(project.experiments, id);
            const auto* method = experiment ? registry.find(experiment->method) : nullptr;
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

QString plot_values_text(const ErrorPlot& plot) {
    projects::Sweep::Axis axis;
    axis.key = plot.over;
    axis.values = plot.values;
    return q(axis_text(axis));
}

QString plot_values_hint(const ErrorPlot& plot) {
    return plot.over == "frames" ? QObject::tr("1, 2, 4, …") : QString();
}

EditMaker set_plot_values(const std::string& plot, const std::string& text) {
    return [=](const projects::Project& project) {
        const auto& now = projects::edits::item_of<ErrorPlot>(project, plot);
        auto values = text.empty() ? std::vector<projects::Json>() : parse_axis(now.over, text);
        return field_edit<ErrorPlot>(
            plot, "values", [values = std::move(values)](ErrorPlot& changed) { changed.values = values; },
            false)(project);
    };
}

EditMaker set_plot_key(const std::string& plot, const std::string& key) {
    return [=](const projects::Project& project) {
        projects::Json value;
        for (const auto& id : projects::edits::item_of<ErrorPlot>(project, plot).experiments)
            if (const auto* first = projects::find_item(project.experiments, id)) {
                value = present_value(projects::effective(*first), key);
                break;
            }
        return field_edit<ErrorPlot>(
            plot, "key",
            [&](ErrorPlot& changed) {
                changed.over = key;
                changed.values.clear();
                if (key != "frames" && !value.is_null()) changed.values.push_back(value);
            },
            false)(project);
    };
}

EditMaker set_plot_metric(const std::string& plot, const std::string& metric) {
    return field_edit<ErrorPlot>(
        plot, "metric", [=](ErrorPlot& changed) { changed.metric = metric; }, false);
}

EditMaker set_plot_axis(const std::string& plot, bool against_time) {
    return field_edit<ErrorPlot>(
        plot, "axis", [=](ErrorPlot& changed) { changed.against_time = against_time; }, false);
}

}  // namespace ir::widgets
