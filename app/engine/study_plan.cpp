#include "app/engine/study_plan.h"

#include <algorithm>
#include <set>

#include "app/engine/execution.h"
#include "projects/coordinate.h"
#include "projects/plots.h"
#include "projects/results.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

using projects::ErrorPlot;
using projects::Json;
using projects::Project;

std::string shown(const Json& json) {
    return projects::printable(json.is_string() ? json.get<std::string>() : projects::canonical_json(json),
                               60);
}

[[noreturn]] void refuse(const ErrorPlot& plot, const std::string& problem) {
    throw UsageError("plot '" + plot.id + "': " + problem);
}

void check_plot(const Project& project, const ErrorPlot& plot) {
    if (plot.experiments.empty()) refuse(plot, "has no experiments; add one");
    if (plot.reference.empty()) refuse(plot, "has no reference; choose one");
    if (!find_item(project.experiments, plot.reference) && !find_item(project.images, plot.reference))
        refuse(plot, "there is no experiment or image '" + projects::printable(plot.reference, 60) +
                         "' to be its reference; choose another");
    const auto& metrics = metric_names();
    if (std::find(metrics.begin(), metrics.end(), plot.metric) == metrics.end())
        refuse(plot,
               "unknown metric '" + projects::printable(plot.metric, 60) + "'; known are " + listed(metrics));
    const auto keys = projects::plot_keys(project, plot, registry());
    if (std::find(keys.begin(), keys.end(), plot.over) == keys.end())
        refuse(plot,
               "cannot run over '" + projects::printable(plot.over, 60) + "'; give one of " + listed(keys));
    if (plot.over != "frames" && plot.values.empty())
        refuse(plot, "has no values; give some of " + plot.over);
}

/// After which frames an experiment is measured; values that are no number of frames have a problem.
std::vector<PlannedPoint> frame_points(const ErrorPlot& plot, const projects::Experiment& experiment) {
    std::vector<PlannedPoint> points;
    const auto run = projects::effective(experiment);
    if (plot.values.empty())
        for (const int frames : projects::doubling_frames(run.frames))
            points.push_back({frames, run, frames});
    for (const auto& value : plot.values) {
        PlannedPoint point{value, run, 0};
        if (value.is_number_integer() && value >= 1 && value <= max_frames)
            point.frames = value;
        else
            point.problem = "'" + shown(value) + "' is no number of frames; give an integer from 1 to " +
                            std::to_string(max_frames);
        points.push_back(std::move(point));
    }
    // The execution goes on to the last of them.
    int last = 1;
    for (const auto& point : points) last = std::max(last, point.frames);
    for (auto& point : points) point.run.frames = last;
    return points;
}

PlannedPoint value_point(const Project& project, const ErrorPlot& plot,
                         const projects::Experiment& experiment, const Json& value) {
    PlannedPoint point{value, projects::effective(experiment), 1};
    point.frames = point.run.frames;
    try {
        point.run = projects::with_coordinate(project, experiment, plot.over, value, registry());
    } catch (const UsageError& error) {
        point.problem = error.what();
    }
    return point;
}

std::vector<PlannedRun> runs_of(const Project& project, const ErrorPlot& plot, const std::string& id) {
    const auto* experiment = find_item(project.experiments, id);
    if (!experiment)
        return {{id, {{nullptr, {}, 1, "there is no experiment '" + projects::printable(id, 60) + "'"}}}};
    if (plot.over == "frames") return {{id, frame_points(plot, *experiment)}};
    std::vector<PlannedRun> runs;
    for (const auto& value : plot.values)
        runs.push_back({id, {value_point(project, plot, *experiment, value)}});
    return runs;
}

/// Whether the point would be the very picture that it is judged by.
bool is_reference_itself(const Project& project, const PlannedPoint& point,
                         const projects::Experiment& reference) {
    auto run = point.run;
    run.frames = point.frames;
    return projects::result_key(project, run, registry()) ==
           projects::result_key(project, reference, registry());
}

void judge(const Project& project, PlannedPoint& point, const projects::Experiment& reference,
           const projects::SceneFacts& facts) {
    if (!point.problem.empty()) return;
    if (!registry().find(point.run.method))
        point.problem = "method '" + projects::printable(point.run.method, 60) + "' is unknown to this build";
    else if (is_reference_itself(project, point, reference))
        point.problem = "is the reference itself";
    else
        point.problem = why_not_judged_by(project, point.run, reference, facts);
}

}  // namespace

std::string why_not_judged_by(const Project& project, const projects::Experiment& experiment,
                              const projects::Experiment& reference, const projects::SceneFacts& facts) {
    // The rule that badges of experiments follow, on a document of these two.
    Project pair = project;
    pair.experiments = {experiment, reference};
    pair.experiments[0].id = reference.id + "-judged";
    pair.experiments[0].reference = reference.id;
    pair.experiments[1].reference.clear();
    const auto found = projects::mismatched_references(pair, registry(), facts);
    return found.empty() ? "" : found.front().second;
}

std::vector<PlannedRun> plan_study(const Project& project, const ErrorPlot& plot,
                                   const projects::SceneFacts& facts) {
    check_plot(project, plot);
    const auto* reference = find_item(project.experiments, plot.reference);
    std::vector<PlannedRun> runs;
    std::set<std::string> seen;
    for (const auto& id : plot.experiments) {
        if (!seen.insert(id).second) continue;
        for (auto& run : runs_of(project, plot, id)) {
            for (auto& point : run.points)
                if (reference && point.problem.empty()) judge(project, point, *reference, facts);
            runs.push_back(std::move(run));
        }
    }
    return runs;
}

}  // namespace ir::engine
