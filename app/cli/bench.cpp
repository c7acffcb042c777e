#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command.h"
#include "app/cli/plot_project.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/engine/benchmarks.h"
#include "app/engine/defaults_benchmark.h"
#include "app/engine/interaction_benchmark.h"
#include "app/engine/interruption.h"
#include "projects/document_fields.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/write_file.h"

namespace ir::cli {

namespace {

constexpr const char* error_name = "error";
constexpr const char* error_doc =
    "A project's plots: error of experiments against time, frames or a parameter; give --project";

std::string list(bool json) {
    const std::pair<const char*, const char*> others[]{{engine::defaults_name, engine::defaults_doc},
                                                       {engine::interaction_name, engine::interaction_doc},
                                                       {error_name, error_doc}};
    auto text = engine::benchmark_list(false);
    auto all = nlohmann::ordered_json::parse(engine::benchmark_list(true));
    for (const auto& [name, doc] : others) {
        text += std::string(name) + "  " + doc + "\n";
        all.push_back({{"name", name}, {"doc", doc}});
    }
    return json ? all.dump(2) + "\n" : text;
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
    std::string name, eye, target, size, csv;
    std::vector<std::string> scenes, variants;
    ProjectPlots plots;
    int repeats = 5;
    bool json = false, quiet = false;
};

/// All but the scene.
engine::BenchmarkOptions benchmark_options(const BenchFlags& flags) {
    engine::BenchmarkOptions options;
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
    auto text = progress.label + " (" + std::to_string(progress.row + 1) + " of " +
                std::to_string(progress.rows) + ")";
    if (progress.repeats == 0) return text + (progress.what.empty() ? "" : ", " + progress.what);
    return text + (progress.repeat == 0
                       ? ", cold"
                       : ", " + std::to_string(progress.repeat) + " of " + std::to_string(progress.repeats));
}

engine::BenchmarkCallbacks benchmark_callbacks(const BenchFlags& flags, ProgressLine& line) {
    engine::BenchmarkCallbacks callbacks;
    callbacks.cancel = &engine::interruption();
    callbacks.memory_budget = parse_bytes(flags.machine.memory);
    callbacks.progress = [&line](const auto& progress) { line.tell(text_of(progress), progress.fraction); };
    return callbacks;
}

/// Whether any variant could be measured.
bool complain_of_rows(const engine::BenchmarkReport& report) {
    for (const auto& row : report.rows)
        if (!row.problem.empty())
            std::cerr << "interreflect-cli: " << row.label << ": " << row.problem << "\n";
    return engine::first_measured(report) != nullptr;
}

void refuse_more_scenes(const BenchFlags& flags) {
    if (flags.scenes.size() > 1)
        throw UsageError("--scene is given more than once, which only the benchmark `defaults` takes");
}

/// Failed where no variant could be measured.
int print_report(const BenchFlags& flags, const engine::BenchmarkReport& report) {
    const bool is_measured = complain_of_rows(report);
    if (!flags.csv.empty()) write_file(flags.csv, engine::benchmark_csv(report));
    std::cout << (flags.json ? engine::benchmark_json(report) : engine::benchmark_text(report));
    return is_measured ? done : failed;
}

/// `run` takes options and callbacks.
template <class Run>
int run_in_one_scene(const BenchFlags& flags, Run run) {
    refuse_more_scenes(flags);
    auto options = benchmark_options(flags);
    if (!flags.scenes.empty()) options.place.scene = flags.scenes.front();
    if (!flags.csv.empty()) require_folder_of(flags.csv, "--csv");
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    const auto report = run(options, benchmark_callbacks(flags, line));
    line.clear();
    return print_report(flags, report);
}

int run_interaction(const BenchFlags& flags) {
    return run_in_one_scene(flags, [&](const auto& options, const auto& callbacks) {
        return engine::run_interaction_benchmark(machine_options(flags.machine), options, callbacks);
    });
}

int run_benchmark(const BenchFlags& flags) {
    const auto& benchmark = engine::find_benchmark(flags.name);
    return run_in_one_scene(flags, [&](const auto& options, const auto& callbacks) {
        engine::Machine machine(machine_options(flags.machine));
        return engine::run_benchmark(machine, benchmark, options, callbacks);
    });
}

std::string heading_of(const engine::BenchmarkReport& report) {
    return report.scene + ", " + std::to_string(report.width) + "x" + std::to_string(report.height) + ", " +
           report.doc + ", " + report.device + "\n";
}

/// A table for each scene and transport.
int run_defaults(const BenchFlags& flags) {
    if (!flags.csv.empty())
        throw UsageError("--csv does not belong to the benchmark `defaults`; take --json");
    auto scenes = flags.scenes;
    if (scenes.empty()) scenes.emplace_back();
    auto options = benchmark_options(flags);
    ProgressLine line(!flags.quiet, static_cast<double>(scenes.size()));
    engine::Machine machine(machine_options(flags.machine));
    auto tables = nlohmann::ordered_json::array();
    std::string text;
    for (const auto& scene : scenes) {
        options.place.scene = scene;
        line.begin(scene, 1);
        const auto reports =
            engine::run_defaults_benchmark(machine, options, benchmark_callbacks(flags, line));
        line.clear();
        for (const auto& report : reports) {
            complain_of_rows(report);
            text += (text.empty() ? "" : "\n") + heading_of(report) + engine::benchmark_table(report);
            tables.push_back(nlohmann::ordered_json::parse(engine::benchmark_json(report)));
        }
    }
    nlohmann::ordered_json json{{"benchmark", engine::defaults_name}};
    json["tables"] = std::move(tables);
    std::cout << (flags.json ? json.dump(2) + "\n" : text);
    return done;
}

}  // namespace

void add_bench(CLI::App& app, Run& run) {
    auto flags = std::make_shared<BenchFlags>();
    auto* command = app.add_subcommand("bench", "Benchmarks; without NAME the list of them");
    command->add_option("NAME", flags->name, "Which to run");
    command
        ->add_option("--scene", flags->scenes,
                     "Scene instead of the benchmark's own; of `defaults` may be given more than once")
        ->allow_extra_args(false);
    command->add_option("--eye", flags->eye, projects::field_of(projects::camera_fields(), "eye").text.doc);
    command->add_option("--target", flags->target,
                        projects::field_of(projects::camera_fields(), "target").text.doc);
    command->add_option("--size", flags->size, "WxH in pixels instead of the benchmark's own");
    command
        ->add_option("--variant", flags->variants,
                     "Label of a variant to run, of `defaults` and `interaction` a method; may be given "
                     "more than once")
        ->allow_extra_args(false);
    command->add_option("--project", flags->plots.project, "Of the benchmark `error`: project with plots");
    command->add_option("--plot", flags->plots.plots, "Of `error`: plots to carry out (default: all)");
    command->add_option("--repeats", flags->repeats, "Runs of which the median counts")
        ->check(CLI::Range(1, max_repeats));
    command->add_option("--csv", flags->csv, "Write the table to this file");
    add_json_flag(*command, flags->json);
    add_quiet_flag(*command, flags->quiet);
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
            if (flags->name == engine::interaction_name) return run_interaction(*flags);
            return flags->name == engine::defaults_name ? run_defaults(*flags) : run_benchmark(*flags);
        };
    });
}

}  // namespace ir::cli
