#include "app/gui/new_plot.h"

#include "renderers/core/error.h"

namespace ir::gui {
namespace {

using projects::Experiment;
using projects::Project;

bool is_truth(const Registry& registry, const Experiment& experiment) {
    const auto* method = registry.find(experiment.method);
    return method && method->is_reference;
}

/// What the experiment is judged by; else any recorded reference, else any experiment of a reference method.
std::string reference_for(const Project& project, const Registry& registry, const std::string& experiment) {
    const auto* chosen = projects::find_item(project.experiments, experiment);
    if (chosen && !chosen->reference.empty()) return chosen->reference;
    for (const auto& each : project.experiments)
        if (!each.reference.empty()) return each.reference;
    for (const auto& each : project.experiments)
        if (is_truth(registry, each)) return each.id;
    return {};
}

}  // namespace

widgets::EditMaker add_error_plot(const Registry& registry, const std::string& experiment) {
    return [&registry, experiment](const Project& project) {
        if (project.experiments.empty()) throw UsageError("a plot needs an experiment; add one first");
        projects::ErrorPlot plot;
        plot.reference = reference_for(project, registry, experiment);
        for (const auto& each : project.experiments)
            if (!plot.reference.empty() && each.reference == plot.reference)
                plot.experiments.push_back(each.id);
        const bool is_said = !plot.experiments.empty();
        for (const auto& each : project.experiments)
            if (!is_said && each.id != plot.reference && !is_truth(registry, each))
                plot.experiments.push_back(each.id);
        plot.name = "Error against time";
        plot.id = projects::free_id_in(project.plots, plot.name);
        return projects::edits::add(project, plot);
    };
}

}  // namespace ir::gui
