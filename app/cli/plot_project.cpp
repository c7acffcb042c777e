#include "app/cli/plot_project.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/cli/shard.h"
#include "app/cli/text_table.h"
#include "app/engine/error_study.h"
#include "app/engine/kept_study.h"
#include "app/engine/study_parts.h"
#include "app/engine/study_plot.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_svg.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;
using engine::value_text;

std::vector<projects::ErrorPlot> chosen_plots(const projects::Project& project, const ProjectPlots& job) {
    std::vector<projects::ErrorPlot> plots;
    for (const auto& id : job.plots) {
        const auto* plot = find_item(project.plots, id);
        if (!plot)
            throw UsageError("no plot '" + id + "' in the project" +
                             known_are(id, words_of(project.plots, &projects::ErrorPlot::id)));
        plots.push_back(*plot);
    }
    if (job.plots.empty()) plots = project.plots;
    if (plots.empty()) throw UsageError("the project has no plots");
    for (const auto& [option, file] : {std::pair("--csv", job.csv), std::pair("--svg", job.svg)})
        if (!file.empty() && plots.size() > 1)
            throw UsageError(std::string(option) + " holds one plot; give its id behind the project");
    const auto& metrics = metric_names();
    if (!job.metric.empty() && std::find(metrics.begin(), metrics.end(), job.metric) == metrics.end())
        throw UsageError("--metric '" + job.metric + "' is unknown" + known_are(job.metric, metrics));
    for (auto& plot : plots)
        if (!job.metric.empty()) plot.metric = job.metric;
    return plots;
}

/// "12.34", five digits that count.
std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

void print_study(std::ostream& out, const projects::ErrorPlot& plot, const engine::ErrorStudy& study) {
    out << plot.id << ": " << plot.name << ", " << study.device << "\n";
    std::vector<std::vector<std::string>> rows{{"experiment", plot.over, "ms", plot.metric, ""}};
    for (const auto& point : study.points) {
        if (!point.problem.empty()) {
            rows.push_back({point.experiment, value_text(point.value), "", "", point.problem});
            continue;
        }
        const auto error = point.errors.find(plot.metric);
        rows.push_back({point.experiment, value_text(point.value), number_text(point.ms),
                        error == point.errors.end() ? "" : number_text(error->second),
                        point.on_front ? "*" : ""});
    }
    print_table(out, rows, {1, 2, 3});
    if (study.reference_noise > 0)
        out << "the reference has an RMSE of about " << number_text(study.reference_noise) << " left\n";
    for (const auto& note : study.notes) out << "note: " << note << "\n";
}

std::string svg_of(const projects::Project& project, const projects::ErrorPlot& plot,
                   const engine::ErrorStudy& study) {
    const auto drawn = engine::draw_study(project, engine::registry(), plot, study, {plot.over, true, true});
    return plot_svg(drawn.data, plot_svg_width, plot_svg_height, true);
}

/// What is wrong with one plot, by whose fault.
int refuse(const ProjectPlots& job, const projects::ErrorPlot& plot, const Error& error) {
    std::string line = error.what();
    const std::string own = "plot '" + plot.id + "'";
    if (line.rfind(own, 0) != 0) line = own + ": " + line;
    complain(job.project + ": " + line);
    return status_of(error);
}

/// A plot without a single number is no plot.
void require_numbers(const projects::ErrorPlot& plot, const engine::ErrorStudy& study) {
    const auto& points = study.points;
    const auto is_measured = [](const auto& point) { return point.problem.empty(); };
    if (points.empty() || std::any_of(points.begin(), points.end(), is_measured)) return;
    const auto problem = "plot '" + plot.id +
                         "': no point could be measured; the first: " + points.front().experiment + ": " +
                         points.front().problem;
    const auto is_refused = [](const auto& point) { return point.is_refused; };
    if (std::any_of(points.begin(), points.end(), is_refused)) throw UsageError(problem);
    throw Error(problem);
}

/// Of a merge.
engine::ErrorStudy joined(engine::Machine& machine, const projects::LoadedProject& loaded,
                          const projects::ErrorPlot& plot) {
    const int count = engine::parts_of_plot(loaded.folder, plot.id);
    if (count == 0) throw Error("no part of it is there; run `plot` with --shard");
    const engine::StudyParts parts(loaded.project, plot, loaded.folder, count);
    if (const auto missing = parts.missing(); !missing.empty())
        throw Error(listed(missing) + "; run the shards that lack them");
    auto study = parts.joined(machine);
    if (!study) throw Error("its parts are being joined by another process");
    engine::keep_study(loaded.project, plot, loaded.folder, *study);
    parts.remove();
    return std::move(*study);
}

/// Kept where the job says so. Of a shard all points where it made the last ones, which then sets `is_whole`,
/// else its own.
engine::ErrorStudy study_of(const ProjectPlots& job, engine::Machine& machine,
                            const projects::LoadedProject& loaded, const projects::ErrorPlot& plot,
                            engine::StudyCallbacks callbacks, bool& is_whole) {
    if (job.merge) return joined(machine, loaded, plot);
    const engine::StudyParts parts(loaded.project, plot, loaded.folder, job.shard.count);
    callbacks.shard = parts.runs_of(job.shard);
    auto study = engine::run_error_study(machine, loaded.project, plot, loaded.folder, callbacks);
    if (!job.keep) return study;
    if (job.shard.count > 1) {
        parts.keep(study, job.shard);
        auto all = parts.joined(machine);
        if (!all) return study;
        study = std::move(*all);
    }
    engine::keep_study(loaded.project, plot, loaded.folder, study);
    if (job.shard.count > 1) parts.remove();
    is_whole = true;
    return study;
}

}  // namespace

int plot_project(const ProjectPlots& job) {
    const auto loaded = load_project(job.project);
    const auto plots = chosen_plots(loaded.project, job);
    OutputFiles files;
    files.reads(loaded);
    for (const auto& [option, file] :
         {std::pair("--json", job.json), std::pair("--csv", job.csv), std::pair("--svg", job.svg)}) {
        files.writes(option, file);
        if (job.shard.count > 1) files.writes(option, file_of_shard(file, job.shard));
    }
    if (job.keep) require_results(job.project, loaded.folder);
    engine::Machine machine(machine_options(job.machine));
    const auto options = frame_options(job.machine);
    ProgressLine line(job.show_progress, static_cast<double>(plots.size()));
    engine::StudyCallbacks callbacks;
    callbacks.cancel = options.cancel;
    callbacks.progress = line.callback();
    callbacks.keeps_reference = job.keep;
    callbacks.repeats = job.repeats;
    callbacks.memory_budget = options.memory_budget;
    auto& table = job.json == "-" ? std::cerr : std::cout;
    Json all = Json::object();
    int status = done;
    bool are_whole = true;
    for (const auto& plot : plots) {
        line.begin(plot.id, 1);
        bool is_whole = job.shard.count == 1;
        try {
            const auto study = study_of(job, machine, loaded, plot, callbacks, is_whole);
            are_whole = are_whole && is_whole;
            const auto place = [&](const std::string& file) {
                return is_whole ? file : file_of_shard(file, job.shard);
            };
            line.clear();
            if (job.shard.count > 1 && study.points.empty()) continue;
            print_study(table, plot, study);
            all[plot.id] = Json::parse(engine::study_json(study));
            if (!job.csv.empty()) write_file(place(job.csv), engine::study_csv(study));
            if (!job.svg.empty()) write_file(place(job.svg), svg_of(loaded.project, plot, study));
            require_numbers(plot, study);
        } catch (const Error& error) {
            are_whole = are_whole && is_whole;
            line.clear();
            status = std::max(status, refuse(job, plot, error));
        }
    }
    if (job.json == "-")
        std::cout << all.dump(2) << "\n";
    else if (!job.json.empty())
        write_file(are_whole ? job.json : file_of_shard(job.json, job.shard), all.dump(2) + "\n");
    return status;
}

}  // namespace ir::cli
