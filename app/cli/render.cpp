#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/inspection.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/render_project.h"
#include "app/cli/run_and_keep.h"
#include "app/cli/run_frames.h"
#include "app/engine/execution.h"
#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "projects/document_fields.h"
#include "projects/match.h"
#include "projects/samples.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

struct RenderFlags {
    MachineFlags machine;
    InspectionFlags inspection;
    std::string project, scene, method, eye, target, up, camera, environment, out, json;
    std::vector<std::string> experiments, sets, lights, dumps;
    std::string size, seed_text;
    double fov_y = 45, time = 0, initial_capacity = 1;
    int frames = 1;
    bool keep = false, quiet = false, match = false;
    double checkpoint = engine::Checkpoints::usual_seconds;
    std::int64_t samples = 0;
};

scene::Environment parse_environment(const std::string& text) {
    if (text.find(',') != std::string::npos && !std::filesystem::exists(text)) {
        const auto radiance = projects::parse_vec3(text, "--env");
        if (glm::any(glm::lessThan(radiance, glm::dvec3(0))))
            throw UsageError("--env '" + text + "': radiance is never negative");
        return {glm::vec3(radiance), nullptr};
    }
    return scene::map_environment(std::make_shared<Image>(read_image(text)));
}

std::uint64_t parse_seed(const std::string& text) {
    std::uint64_t seed = 0;
    if (text.empty()) return seed;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
        throw UsageError("--seed '" + text + "' is not an integer from 0 to 18446744073709551615");
    return seed;
}

/// Options that say what to render mean nothing beside the other way to say it, and are refused.
void refuse_given(const CLI::App& command, const std::vector<std::string>& options, const std::string& why) {
    for (const auto& option : options)
        if (command.count(option) > 0) throw UsageError(option + " cannot be used " + why);
}

Settings parse_settings(const MethodDescription& method, const std::vector<std::string>& sets) {
    Settings settings;
    for (const auto& text : sets) {
        const auto equals = text.find('=');
        if (equals == std::string::npos)
            throw UsageError("--set '" + text + "' is not of the form key=value");
        const auto key = text.substr(0, equals);
        const auto* parameter = find(method.parameters, key);
        if (!parameter)
            completed(method.parameters, {{key, Value{false}}});  // throws, listing the known keys
        settings[key] = parameter->parse(text.substr(equals + 1));
    }
    return settings;
}

engine::Experiment to_experiment(const RenderFlags& flags) {
    engine::Experiment e;
    e.scene = flags.scene;
    e.method = flags.method;
    e.settings = parse_settings(engine::registry().at(flags.method), flags.sets);
    if (!flags.eye.empty() || !flags.target.empty()) {
        if (!flags.camera.empty()) throw UsageError("give --camera or --eye and --target, not both");
        if (flags.eye.empty() || flags.target.empty()) throw UsageError("--eye and --target belong together");
        scene::Camera camera;
        camera.eye = projects::parse_vec3(flags.eye, "--eye");
        camera.target = projects::parse_vec3(flags.target, "--target");
        camera.up = flags.up.empty() ? glm::vec3(0, 1, 0) : glm::vec3(projects::parse_vec3(flags.up, "--up"));
        for (const auto& [option, point] :
             {std::pair("--eye", camera.eye), {"--target", camera.target}, {"--up", camera.up}})
            if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
                throw UsageError(std::string(option) + " is beyond what single precision holds");
        camera.fov_y = static_cast<float>(glm::radians(flags.fov_y));
        if (glm::length(camera.target - camera.eye) < 1e-9f)
            throw UsageError("--eye and --target are the same point");
        if (glm::length(glm::cross(camera.target - camera.eye, camera.up)) < 1e-9f)
            throw UsageError("--up points along the view; give another direction");
        e.camera = camera;
    }
    e.camera_name = flags.camera;
    for (const auto& light : flags.lights) {
        e.replace_lights = true;
        e.lights.push_back(engine::to_scene_light(projects::parse_light(light),
                                                  "light " + std::to_string(e.lights.size() + 1)));
    }
    if (!flags.environment.empty()) e.environment = parse_environment(flags.environment);
    e.seed = parse_seed(flags.seed_text);
    const auto size = flags.size.empty() ? glm::ivec2(800, 600) : projects::parse_size(flags.size, "--size");
    e.width = size.x;
    e.height = size.y;
    e.frames = flags.frames;
    e.time = flags.time;
    return e;
}

/// The ground truth of an experiment in its place.
void match(engine::Experiment& experiment, std::int64_t samples) {
    const auto& registry = engine::registry();
    projects::Experiment truth;
    truth.method = experiment.method;
    truth.values = experiment.settings;
    truth.frames = experiment.frames;
    truth.time = experiment.time;
    truth = projects::ground_truth(truth, registry);
    if (samples > 0)
        truth = projects::with_sample_count(truth, static_cast<std::uint64_t>(samples), registry);
    experiment.method = truth.method;
    experiment.settings = truth.values;
    experiment.frames = truth.frames;
    experiment.time = truth.time;
}

int render_scene(const RenderFlags& flags) {
    auto experiment = to_experiment(flags);
    if (flags.match) match(experiment, flags.samples);
    const auto inspection = parse_inspection(flags.inspection, experiment);
    if (std::filesystem::path(flags.out).extension() != ".exr")
        throw UsageError("--out '" + flags.out + "' must end in .exr");
    OutputFiles files;
    files.reads("--scene", flags.scene);
    files.reads("--env", flags.environment);
    files.writes("--out", flags.out);
    files.writes("--json", flags.json);
    require_folder_of(flags.out, "--out");
    if (!flags.json.empty() && flags.json != "-") require_folder_of(flags.json, "--json");
    engine::Machine machine(machine_options(flags.machine));
    engine::Execution execution(machine, experiment);
    execution.inspect(inspection);
    auto options = frame_options(flags.machine, flags.dumps, flags.initial_capacity);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    options.progress = line.callback();
    FrameReport report;
    try {
        report = engine::run_frames(execution, options);
    } catch (const Cancelled&) {
        line.clear();
        std::cerr << "interreflect-cli: " << flags.out << " is not written\n";
        throw;
    }
    line.clear();
    if (experiment.environment && !find(execution.method().parameters, "environment_light"))
        report.messages.push_back(
            {Severity::note, "render",
             "method '" + experiment.method + "' does not use the environment that --env gives"});
    for (auto& warning : inspection_warnings(inspection, experiment))
        report.messages.push_back(std::move(warning));
    warn_of_unmatched(flags.dumps, report);
    if (!flags.quiet) note_lists(flags.dumps, report);
    write_exr(flags.out, layers(execution, flags.dumps), attributes(execution));
    print_messages(execution, report);
    if (flags.json == "-")
        std::cout << engine::statistics_json(report) << "\n";
    else if (!flags.json.empty())
        write_file(flags.json, engine::statistics_json(report) + "\n");
    return done;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    auto flags = std::make_shared<RenderFlags>();
    auto* command =
        app.add_subcommand("render", "Render a project's experiments, or one scene by one method");
    command->add_option("PROJECT", flags->project,
                        "Project folder; or leave out and give --scene and --method");
    command->add_option("--experiment", flags->experiments, "Id of an experiment to render (default: all)");
    command->add_option("--scene", flags->scene, "A .gltf or .glb file, or builtin:NAME");
    command->add_option("--method", flags->method, method_doc);
    const auto camera_text = [](const char* key) {
        return projects::field_of(projects::camera_fields(), key).text;
    };
    const auto text = [](const char* key) {
        return projects::field_of(projects::experiment_fields(), key).text;
    };
    command->add_option("--eye", flags->eye, camera_text("eye").doc);
    command->add_option("--target", flags->target, camera_text("target").doc);
    command->add_option("--up", flags->up, camera_text("up").doc + " (default 0,1,0)");
    command->add_option("--fov-y", flags->fov_y, camera_text("fov_y_degrees").doc)
        ->check(within(camera_text("fov_y_degrees")));
    command->add_option("--camera", flags->camera, "Name of one of the scene's cameras");
    command->add_option("--size", flags->size, text("size").doc + ", as 800x600 (the default)");
    command->add_option("--set", flags->sets, "Parameter key=value; repeat for more");
    command->add_option(
        "--light", flags->lights,
        "Light that replaces the scene's, such as point:position=0,2,0;flux=40; a rect's size is "
        "its width, held level (along X where it points straight up or down), and height");
    command->add_option("--env", flags->environment, "Environment: an image file, or radiance r,g,b");
    command->add_option("--seed", flags->seed_text, text("seed").doc);
    command->add_option("--frames", flags->frames, text("frames").doc)->check(whole_within(text("frames")));
    command->add_option("--time", flags->time, text("time").doc)->check(within(text("time")));
    command->add_option("--dump", flags->dumps, "Pattern of buffers to write as layers, such as 'gbuffer.*'");
    command->add_option("--pick", flags->inspection.pick,
                        "Pixel x,y that outputs which explain are computed for");
    command->add_option("--choose", flags->inspection.chooses,
                        "Item that such outputs show, such as map=3 or map=all; repeat for more");
    command->add_option("--out", flags->out, "File.exr; for a project a folder")->required();
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
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, command, &run] {
        if (command->count("--json") && flags->json.empty()) flags->json = "-";
        run = [flags, command] {
            if (!flags->project.empty()) {
                if (!flags->scene.empty() || !flags->method.empty())
                    throw UsageError("give a PROJECT, or --scene and --method, not both");
                refuse_given(
                    *command,
                    {"--eye", "--target", "--up", "--fov-y", "--camera", "--size", "--set", "--light",
                     "--env", "--seed", "--frames", "--time", "--initial-capacity", "--match", "--samples"},
                    "with a PROJECT, whose experiments say it; change the project or give --scene "
                    "and --method");
                if (!flags->keep) refuse_given(*command, {"--checkpoint"}, "without --keep");
                return render_project({flags->machine, flags->project, flags->out, flags->experiments,
                                       flags->dumps, flags->inspection, flags->keep, !flags->quiet,
                                       flags->json, flags->checkpoint});
            }
            if (flags->scene.empty() || flags->method.empty())
                throw UsageError("give a PROJECT, or --scene and --method");
            refuse_given(*command, {"--keep", "--experiment", "--checkpoint"}, "without a PROJECT");
            if (!flags->match) refuse_given(*command, {"--samples"}, "without --match");
            if (flags->eye.empty()) refuse_given(*command, {"--fov-y", "--up"}, "without --eye and --target");
            return render_scene(*flags);
        };
    });
}

}  // namespace ir::cli
