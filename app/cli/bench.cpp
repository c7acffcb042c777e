#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/plot_project.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/engine/benchmarks.h"
#include "app/engine/interruption.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"

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

struct BenchFlags {
    MachineFlags machine;
    std::string name, scene, eye, target, size, csv;
    std::vector<std::string> variants;
    ProjectPlots plots;
    int repeats = 5;
    bool json = false, quiet = false;
};

engine::BenchmarkOptions benchmark_options(const BenchFlags& flags) {
    engine::BenchmarkOptions options;
    options.place.scene = flags.scene;
    if (!flags.eye.empty() || !flags.target.empty()) {
        auto& camera = options.place.camera.emplace();
        camera.eye = projects::parse_vec3(flags.eye, "--eye");
        camera.target = projects::parse_vec3(flags.target, "--target");
    }
    if (!flags.size.empty()) options.size = projects::parse_size(flags.size, "--size");
    options.variants = flags.variants;
    options.repeats = flags.repeats;
    return options;
}

std::string text_of(const engine::BenchmarkProgress& progress) {
    return progress.label + " (" + std::to_string(progress.row + 1) + " of " + std::to_string(progress.rows) +
           "), " + (progress.repeat == 0 ? "cold" : std::to_string(progress.repeat));
}

/// Failed where no variant could be measured.
int run_benchmark(const BenchFlags& flags) {
    const auto& benchmark = engine::find_benchmark(flags.name);
    const auto options = benchmark_options(flags);
    if (!flags.csv.empty()) require_folder_of(flags.csv, "--csv");
    engine::BenchmarkCallbacks callbacks;
    callbacks.cancel = &engine::interruption();
    callbacks.memory_budget = parse_bytes(flags.machine.memory);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    callbacks.progress = [&](const auto& progress) { line.tell(text_of(progress), progress.fraction); };
    engine::Machine machine(machine_options(flags.machine));
    const auto report = engine::run_benchmark(machine, benchmark, options, callbacks);
    line.clear();
    for (const auto& row : report.rows)
        if (!row.problem.empty())
            std::cerr << "interreflect-cli: " << row.label << ": " << row.problem << "\n";
    if (!flags.csv.empty()) write_file(flags.csv, engine::benchmark_csv(report));
    std::cout << (flags.json ? engine::benchmark_json(report) : engine::benchmark_text(report));
    return engine::first_measured(report) ? done : failed;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    auto flags = std::make_shared<BenchFlags>();
    auto* command = app.add_subcommand("bench", "Benchmarks; without NAME the list of them");
    command->add_option("NAME", flags->name, "Which to run");
    command->add_option("--scene", flags->scene, "Scene instead of the benchmark's own");
    command->add_option("--eye", flags->eye, "Camera position x,y,z in metres");
    command->add_option("--target", flags->target, "Point that the camera looks at, x,y,z");
    command->add_option("--size", flags->size, "WxH in pixels instead of the benchmark's own");
    command
        ->add_option("--variant", flags->variants, "Label of a variant to run; may be given more than once")
        ->allow_extra_args(false);
    command->add_option("--project", flags->plots.project, "Of the benchmark `error`: project with plots");
    command->add_option("--plot", flags->plots.plots, "Of `error`: plots to carry out (default: all)");
    command->add_option("--repeats", flags->repeats, "Runs of which the median counts")
        ->check(CLI::Range(1, 1000));
    command->add_option("--csv", flags->csv, "Write the table to this file");
    command->add_flag("--json", flags->json, "Print one JSON object");
    command->add_flag("--quiet", flags->quiet, "No progress on standard error");
    add_machine_flags(*command, flags->machine);
    command->callback([flags, command, &run] {
        if (command->count("--repeats") > 0) flags->plots.repeats = flags->repeats;
        flags->plots.show_progress = !flags->quiet;
        run = [flags] {
            if (flags->name.empty()) {
                std::cout << list(flags->json);
                return static_cast<int>(done);
            }
            if (flags->name == error_name) {
                if (!flags->csv.empty() || !flags->size.empty() || !flags->variants.empty())
                    throw UsageError("--csv, --size and --variant do not belong to the benchmark `error`");
                return run_plots(flags->plots, flags->machine, flags->json);
            }
            if (!flags->plots.project.empty() || !flags->plots.plots.empty())
                throw UsageError("--project and --plot belong to the benchmark `error`");
            return run_benchmark(*flags);
        };
    });
}

}  // namespace ir::cli
