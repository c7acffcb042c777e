#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/plot_project.h"
#include "app/cli/run_frames.h"
#include "app/engine/benchmarks.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"

namespace ir::cli {

namespace {

constexpr const char* error_name = "error";
constexpr const char* error_doc =
    "A project's plots: error of experiments against time, frames or a parameter; give --project";

std::string list(bool json) {
    if (!json) return engine::benchmark_list(false) + error_name + "  " + error_doc + "\n";
    auto all = nlohmann::ordered_json::parse(engine::benchmark_list(true));
    all.push_back({{"name", error_name}, {"doc", error_doc}});
    return all.dump(2) + "\n";
}

/// Measures only: what a project keeps is left as it is.
int run_plots(ProjectPlots job, const MachineFlags& machine, bool json) {
    if (job.project.empty()) throw UsageError("the benchmark `error` needs --project, a project with plots");
    job.machine = machine;
    job.keep = false;
    if (json) job.json = "-";
    return plot_project(job);
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    struct Flags {
        MachineFlags machine;
        std::string name, scene, eye, target;
        ProjectPlots plots;
        int repeats = 5;
        bool json = false;
    };
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand("bench", "Benchmarks; without NAME the list of them");
    command->add_option("NAME", flags->name, "Which to run");
    command->add_option("--scene", flags->scene, "Scene instead of the benchmark's own");
    command->add_option("--eye", flags->eye, "Camera position x,y,z in metres");
    command->add_option("--target", flags->target, "Point that the camera looks at, x,y,z");
    command->add_option("--project", flags->plots.project, "Of the benchmark `error`: project with plots");
    command->add_option("--plot", flags->plots.plots, "Of `error`: plots to carry out (default: all)");
    command->add_option("--repeats", flags->repeats, "Runs of which the median counts")
        ->check(CLI::Range(1, 1000));
    command->add_flag("--json", flags->json, "Print one JSON object");
    add_machine_flags(*command, flags->machine);
    command->callback([flags, command, &run] {
        if (command->count("--repeats") > 0) flags->plots.repeats = flags->repeats;
        run = [flags] {
            if (flags->name.empty()) {
                std::cout << list(flags->json);
                return static_cast<int>(done);
            }
            if (flags->name == error_name) return run_plots(flags->plots, flags->machine, flags->json);
            if (!flags->plots.project.empty() || !flags->plots.plots.empty())
                throw UsageError("--project and --plot belong to the benchmark `error`");
            std::optional<scene::Camera> camera;
            if (!flags->eye.empty() || !flags->target.empty()) {
                camera.emplace();
                camera->eye = projects::parse_vec3(flags->eye, "--eye");
                camera->target = projects::parse_vec3(flags->target, "--target");
            }
            engine::Machine machine(machine_options(flags->machine));
            std::cout << engine::run_benchmark(machine, flags->name,
                                               {flags->scene, camera, flags->repeats, flags->json});
            return static_cast<int>(done);
        };
    });
}

}  // namespace ir::cli
