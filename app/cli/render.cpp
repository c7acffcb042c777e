#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/inspection.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/render_project.h"
#include "app/cli/run_and_keep.h"
#include "app/cli/run_frames.h"
#include "app/cli/shard.h"
#include "app/engine/execution.h"
#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "projects/light_help.h"
#include "projects/light_spec.h"
#include "projects/match.h"
#include "projects/samples.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

struct RenderFlags {
    MachineFlags machine;
    ExperimentFlags experiment;
    InspectionFlags inspection;
    ShardFlags shard;
    std::string project, scene, method, environment, out, json;
    std::vector<std::string> experiments, lights, dumps;
    double initial_capacity = 1;
    bool keep = false, quiet = false, match = false;
    double checkpoint = engine::Checkpoints::usual_seconds;
    std::int64_t samples = 0;
};

projects::Environment parse_environment(const std::string& text) {
    using Kind = projects::Environment::Kind;
    projects::Environment environment;
    if (text.find(',') == std::string::npos || std::filesystem::exists(text)) {
        environment.kind = Kind::map;
        environment.source = text;
        return environment;
    }
    environment.kind = Kind::constant;
    environment.constant = projects::parse_vec3(text, "--env");
    if (glm::any(glm::lessThan(environment.constant, glm::dvec3(0))))
        throw UsageError("--env '" + text + "': radiance is never negative");
    return environment;
}

/// Options that say what to render mean nothing beside the other way to say it, and are refused.
void refuse_given(const CLI::App& command, const std::vector<std::string>& options, const std::string& why) {
    for (const auto& option : options)
        if (command.count(option) > 0) throw UsageError(option + " cannot be used " + why);
}

/// The project that --scene and --method stand for: one experiment of one scene.
projects::Project to_project(const RenderFlags& flags) {
    auto project = engine::project_of(flags.scene, flags.method);
    auto& experiment = project.experiments.front();
    if (!flags.lights.empty() || !flags.environment.empty()) {
        projects::LightSet lights;
        lights.id = lights.name = experiment.lights = "light";
        lights.use_scene_lights = flags.lights.empty();
        for (const auto& light : flags.lights) lights.lights.push_back(projects::parse_light(light));
        if (!flags.environment.empty()) lights.environment = parse_environment(flags.environment);
        project.lights = {lights};
    }
    apply(flags.experiment, project, experiment);
    if (flags.match) {
        experiment = projects::ground_truth(experiment, engine::registry());
        if (flags.samples > 0)
            experiment = projects::with_sample_count(experiment, static_cast<std::uint64_t>(flags.samples),
                                                     engine::registry());
    }
    return project;
}

int render_scene(const RenderFlags& flags) {
    const auto experiment = engine::from_single(to_project(flags));
    const auto inspection = parse_inspection(flags.inspection, experiment);
    require_picture(flags.out, flags.dumps);
    OutputFiles files;
    files.reads("--scene", flags.scene);
    files.reads("--env", flags.environment);
    files.writes("--out", flags.out);
    files.writes("--json", flags.json);
    if (!flags.json.empty() && flags.json != "-") require_folder_of(flags.json, "--json");
    engine::Machine machine(machine_options(flags.machine));
    engine::Execution execution(machine, experiment);
    execution.inspect(inspection);
    auto options = frame_options(flags.machine, flags.dumps, flags.initial_capacity);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    options.progress = line.callback();
    auto report = under_progress(line, flags.out, [&] { return engine::run_frames(execution, options); });
    if (experiment.environment && !find(execution.method().parameters, "environment_light"))
        report.messages.push_back(
            {Severity::note, "render",
             "method '" + experiment.method + "' does not use the environment that --env gives"});
    note_host_bodies(flags.machine, experiment, report);
    for (auto& warning : inspection_warnings(inspection, experiment))
        report.messages.push_back(std::move(warning));
    for (auto& note : notes_of(flags.experiment, experiment.method, experiment.settings))
        report.messages.push_back(std::move(note));
    engine::require_matches("--dump", flags.dumps, report);
    if (!flags.quiet) note_lists(flags.dumps, report);
    engine::write_picture(flags.out, execution, flags.dumps);
    print_messages(execution, report);
    const auto statistics = engine::statistics_json(execution, report) + "\n";
    if (flags.json != "-")
        for (const auto& each : report.printed)
            std::cout << each.place << ": " << each.label << " = " << each.text << "\n";
    if (flags.json == "-")
        std::cout << statistics;
    else if (!flags.json.empty())
        write_file(flags.json, statistics);
    return done;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    auto flags = std::make_shared<RenderFlags>();
    auto* command =
        app.add_subcommand("render", "Render a project's experiments, or one scene by one method");
    command
        ->add_option("PROJECT", flags->project, "Project folder; or leave out and give --scene and --method")
        ->check(no_scene());
    command->add_option("--experiment", flags->experiments, "Id of an experiment to render (default: all)");
    command->add_option("--scene", flags->scene, "A .gltf or .glb file, or builtin:NAME");
    command->add_option("--method", flags->method, method_doc);
    add_experiment_flags(*command, flags->experiment);
    command
        ->add_option(
            "--light", flags->lights,
            "Light that replaces the scene's, such as point:position=0,2,0;flux=40 (help lists types "
            "and fields); a rect's size is its width, held level (along X where it points straight up "
            "or down), and height")
        ->each([](const std::string& spec) {
            // Printed as a version is, whatever else is missing.
            if (spec == "help")
                throw CLI::CallForVersion(
                    projects::light_help() +
                        "\n\nQuote a light: shells end a command at ';'. The sky is --env. Where a scene lies "
                        "and how large it is: interreflect-cli scene SCENE.",
                    done);
        });
    command->add_option("--env", flags->environment, "Environment: an image file, or radiance r,g,b");
    command->add_option("--dump", flags->dumps, "Pattern of buffers to write as layers, such as 'gbuffer.*'");
    command->add_option("--pick", flags->inspection.pick,
                        "Pixel x,y that outputs which explain are computed for, and that shaders print for");
    command->add_option("--choose", flags->inspection.chooses,
                        "Item that such outputs show, such as map=3 or map=all; repeat for more");
    command
        ->add_option("--out", flags->out,
                     "File.exr, or .png for the main result alone; for a project a folder")
        ->required();
    command->add_option("--json", flags->json, "File for the statistics; - or nothing: standard output")
        ->expected(0, 1)
        ->default_str("-");
    command
        ->add_option("--initial-capacity", flags->initial_capacity,
                     "Factor on the first size of growing buffers (to test growth)")
        ->check(within(1e-9, 1e3));
    command->add_flag("--match", flags->match,
                      "Render the ground truth of --method and its --set instead: the same transport by the "
                      "reference");
    command->add_option("--samples", flags->samples, "With --match: how many samples")
        ->check(CLI::Range(std::int64_t{1}, max_samples));
    command->add_flag("--keep", flags->keep,
                      "Keep the results in the project; what accumulates goes on from the kept state");
    add_checkpoint_flag(*command, flags->checkpoint);
    add_shard_flags(*command, flags->shard, "experiment of a PROJECT");
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, command, &run] {
        if (command->count("--json") && flags->json.empty()) flags->json = "-";
        run = [flags, command] {
            if (!flags->project.empty()) {
                if (!flags->scene.empty() || !flags->method.empty())
                    throw UsageError("give a PROJECT, or --scene and --method, not both");
                refuse_given(*command, {"--light", "--env", "--initial-capacity", "--match", "--samples"},
                             "with a PROJECT, whose experiments say it; change the project or give --scene "
                             "and --method");
                if (flags->keep && flags->experiment != ExperimentFlags{})
                    throw UsageError(
                        "--keep keeps results of the project's experiments as they stand there; "
                        "change the project, or leave out what changes them");
                if (!flags->keep) refuse_given(*command, {"--checkpoint"}, "without --keep");
                return render_project({flags->machine, flags->project, flags->out, flags->experiments,
                                       flags->dumps, flags->inspection, flags->keep, !flags->quiet,
                                       flags->json, flags->checkpoint, flags->experiment,
                                       chosen_shard(flags->shard)});
            }
            if (flags->scene.empty() || flags->method.empty())
                throw UsageError("give a PROJECT, or --scene and --method");
            refuse_given(*command, {"--keep", "--experiment", "--checkpoint", "--shard", "--shard-from-env"},
                         "without a PROJECT");
            if (!flags->match) refuse_given(*command, {"--samples"}, "without --match");
            return render_scene(*flags);
        };
    });
}

}  // namespace ir::cli
