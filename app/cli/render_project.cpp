#include "app/cli/render_project.h"

#include <iostream>

#include "app/cli/run_frames.h"
#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "projects/open_project.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

std::vector<std::string> chosen_ids(const projects::Project& project, const std::vector<std::string>& asked) {
    if (!asked.empty()) {
        for (const auto& id : asked)
            if (!projects::find_item(project.experiments, id)) {
                std::string known;
                for (const auto& experiment : project.experiments)
                    known += (known.empty() ? "" : ", ") + experiment.id;
                throw UsageError("no experiment '" + id + "' in the project; there are " + known);
            }
        return asked;
    }
    std::vector<std::string> ids;
    for (const auto& experiment : project.experiments) ids.push_back(experiment.id);
    if (ids.empty()) throw UsageError("the project has no experiments to render");
    return ids;
}

/// A result's fourth channel is no opacity.
Image without_alpha(const Image& image) {
    if (image.channels != 4) return image;
    Image result(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c) result.at(x, y, c) = image.at(x, y, c);
    return result;
}

void render_one(const ProjectRender& job, engine::Machine& machine, const projects::Project& project,
                const projects::Experiment& experiment, const std::filesystem::path& folder,
                projects::OpenProject* keep_in) {
    engine::Execution execution(machine, engine::from_project(project, experiment, folder));
    const auto report = run_frames(execution, frame_options(job.machine, job.dumps, 1, job.show_progress));
    warn_of_unmatched(job.dumps, report);
    const auto stem = std::filesystem::path(job.out) / experiment.id;
    const auto with = [&](const char* extension) { return std::filesystem::path(stem.string() + extension); };
    write_exr(with(".exr"), execution.layers(job.dumps), execution.attributes());
    write_png(with(".png"), without_alpha(execution.main_result()));
    write_text(with(".json"), engine::statistics_json(report) + "\n");
    print_messages(execution, report);
    if (keep_in)
        keep_in->mark_kept(experiment.id,
                           engine::keep_result(project, experiment, folder, execution, report));
    std::cout << experiment.id << "  " << with(".exr").string() << "  " << static_cast<long>(report.wall_ms)
              << " ms\n";
}

}  // namespace

int render_project(const ProjectRender& job) {
    const auto& registry = engine::registry();
    std::unique_ptr<projects::OpenProject> editable;
    projects::LoadedProject loaded;
    if (job.keep) {
        editable = std::make_unique<projects::OpenProject>(job.project, registry);
        if (editable->is_read_only())
            throw Error(job.project + ": cannot keep results: " + editable->read_only_reason());
    }
    loaded = projects::load_project(job.project, registry);
    for (const auto& message : loaded.messages) std::cerr << "note: " << message.text << "\n";
    const auto ids = chosen_ids(loaded.project, job.experiments);
    std::error_code error;
    std::filesystem::create_directories(job.out, error);
    if (error) throw Error("--out " + job.out + ": cannot be created (" + error.message() + ")");
    engine::Machine machine(machine_options(job.machine));
    for (const auto& id : ids) {
        const auto& experiment = *projects::find_item(loaded.project.experiments, id);
        render_one(job, machine, loaded.project, experiment, loaded.folder, editable.get());
    }
    if (editable) editable->save();
    return done;
}

}  // namespace ir::cli
