#include "app/cli/render_project.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/run_and_keep.h"
#include "app/cli/run_frames.h"
#include "app/cli/shard.h"
#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

std::vector<std::string> chosen_ids(const projects::Project& project,
                                    const std::vector<std::string>& requested) {
    if (!requested.empty()) {
        for (const auto& id : requested) projects::experiment_of(project, id);
        return requested;
    }
    std::vector<std::string> ids;
    for (const auto& experiment : project.experiments) ids.push_back(experiment.id);
    if (ids.empty()) throw UsageError("the project has no experiments to render");
    return ids;
}

/// What the command line got wrong, not the project.
class WrongFlags : public UsageError {
    using UsageError::UsageError;
};

Inspection inspection_of(const ProjectRender& job, const engine::Experiment& experiment) {
    // What the project has wrong is told first.
    completed(engine::registry().at(experiment.method).parameters, experiment.settings);
    try {
        return parse_inspection(job.inspection, experiment);
    } catch (const UsageError& error) {
        throw WrongFlags(error.what());
    }
}

}  // namespace

std::string render_one(const ProjectRender& job, engine::Machine& machine, const projects::Project& project,
                       const projects::Experiment& experiment, const std::filesystem::path& folder,
                       ProgressLine& line) {
    const auto resolved = engine::from_project(project, experiment, folder);
    const auto inspection = inspection_of(job, resolved);
    engine::Execution execution(machine, resolved);
    execution.inspect(inspection);
    const auto stem = std::filesystem::path(job.out) / experiment.id;
    const auto with = [&](const char* extension) { return std::filesystem::path(stem.string() + extension); };
    auto options = frame_options(job.machine, job.dumps);
    line.begin(experiment.id, frames_of(experiment));
    options.progress = line.callback();
    auto run = under_progress(line, with(".exr").string(), [&] {
        if (job.keep)
            return run_and_keep(execution, options, project, experiment, folder, job.checkpoint, line);
        KeptRun shown;
        shown.report = engine::run_frames(execution, options);
        return shown;
    });
    auto& report = run.report;
    for (auto& warning : inspection_warnings(inspection, resolved))
        report.messages.push_back(std::move(warning));
    note_host_bodies(job.machine, resolved, report);
    for (auto& note : notes_of(job.changes, resolved.method, resolved.settings))
        report.messages.push_back(std::move(note));
    engine::require_matches("--dump", job.dumps, report);
    engine::write_picture(with(".exr"), execution, job.dumps);
    engine::write_picture(with(".png"), execution, {});
    const auto statistics = engine::statistics_json(execution, report);
    write_file(with(".json"), statistics + "\n");
    print_messages(execution, report);
    (job.json == "-" ? std::cerr : std::cout) << experiment.id << "  " << with(".exr").string() << "  "
                                              << static_cast<long>(report.wall_ms) << " ms\n";
    return statistics;
}

double frames_of(const projects::Experiment& experiment) {
    return std::max(1, projects::effective(experiment).frames);
}

int render_project(const ProjectRender& job) {
    const auto loaded = load_project(job.project);
    const auto ids = part_of(chosen_ids(loaded.project, job.experiments), job.shard);
    if (const auto ending = std::filesystem::path(job.out).extension();
        (ending == ".exr" || ending == ".png") && !std::filesystem::is_directory(job.out))
        throw UsageError("--out '" + job.out +
                         "': give a folder; each experiment makes files of its own in it");
    OutputFiles files;
    files.reads(loaded);
    for (const auto& id : std::set(ids.begin(), ids.end()))
        for (const char* extension : {".exr", ".png", ".json"})
            files.writes("--out", (std::filesystem::path(job.out) / (id + extension)).string());
    const auto json = file_of_shard(job.json, job.shard);
    files.writes("--json", json);
    if (job.keep) require_results(job.project, loaded.folder);
    make_out_folder(job.out);
    engine::Machine machine(machine_options(job.machine));
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    int status = done;
    auto project = loaded.project;
    std::set<std::string> allowed;  // experiments whose shaders may run; what one may, others may not
    double frames = 0;
    for (const auto& id : std::set(ids.begin(), ids.end())) {
        project.shaders_allowed = loaded.project.shaders_allowed;
        auto& experiment = *projects::find_item(project.experiments, id);
        try {
            if (job.changes != ExperimentFlags{}) apply(job.changes, project, experiment);
        } catch (const UsageError& error) {
            throw UsageError("experiment '" + id + "': " + error.what() +
                             "; --experiment chooses those that are meant");
        }
        if (project.shaders_allowed) allowed.insert(id);
        frames += frames_of(experiment);
    }
    ProgressLine line(job.show_progress, frames);
    const auto write_statistics = [&] {
        if (job.json == "-")
            std::cout << all.dump(2) << "\n";
        else if (!json.empty())
            write_file(json, all.dump(2) + "\n");
    };
    for (const auto& id : ids) {
        project.shaders_allowed = allowed.count(id) != 0;
        const auto& experiment = *projects::find_item(project.experiments, id);
        try {
            const auto statistics = render_one(job, machine, project, experiment, loaded.folder, line);
            all[id] = nlohmann::ordered_json::parse(statistics);
        } catch (const Cancelled&) {
            write_statistics();
            throw;
        } catch (const Error& error) {
            line.clear();
            complain(job.project + ": experiment '" + id + "': " + error.what());
            const bool is_usage = dynamic_cast<const WrongFlags*>(&error);
            status = std::max(status, is_usage ? int{wrong_usage} : status_of(error));
        }
    }
    write_statistics();
    return status;
}

}  // namespace ir::cli
