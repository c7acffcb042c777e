#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/render_project.h"
#include "app/cli/results.h"
#include "app/cli/run_frames.h"
#include "app/engine/execution.h"
#include "app/engine/from_project.h"
#include "app/engine/interruption.h"
#include "app/engine/moving.h"
#include "app/engine/number_text.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "projects/autosave.h"
#include "projects/check.h"
#include "projects/hash.h"
#include "projects/match.h"
#include "projects/pack.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "renderers/image/metrics.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ProjectFlags {
    MachineFlags machine;
    std::string project, pack, unpack;
    std::vector<std::string> changes;
    bool check = false, upgrade = false, verify = false, prune = false, results = false, json = false,
         quiet = false;
};

const char* word(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

const char* word(projects::ResultState state) {
    return state == projects::ResultState::none    ? "none"
           : state == projects::ResultState::stale ? "stale"
                                                   : "current";
}

Json to_json(const std::vector<Message>& messages) {
    Json list = Json::array();
    for (const auto& message : messages)
        list.push_back(
            {{"severity", word(message.severity)}, {"source", message.source}, {"text", message.text}});
    return list;
}

void print(const std::vector<Message>& messages) {
    for (const auto& message : messages) std::cout << word(message.severity) << ": " << message.text << "\n";
}

Json sources(const projects::Scene& scene) {
    Json list = Json::array();
    for (const auto& part : scene.parts) list.push_back(part.source);
    return list;
}

Json summary(const projects::LoadedProject& loaded) {
    const auto& project = loaded.project;
    const auto now = as_on_disk(loaded);
    Json json{{"name", project.name}, {"schema", project.schema}, {"folder", loaded.folder.string()}};
    json["scenes"] = Json::array();
    for (const auto& scene : project.scenes)
        json["scenes"].push_back({{"id", scene.id}, {"name", scene.name}, {"sources", sources(scene)}});
    json["experiments"] = Json::array();
    for (const auto& experiment : project.experiments) {
        auto shaders = Json::object();
        for (const auto& [file, hunks] : experiment.shaders) shaders[file] = count_lines(hunks).text();
        json["experiments"].push_back(
            {{"id", experiment.id},
             {"name", experiment.name},
             {"method", experiment.method},
             {"scene", experiment.scene},
             {"preset", experiment.active_preset},
             {"runnable",
              projects::why_not_runnable(project, experiment, engine::registry(), loaded.folder).empty()},
             {"result", word(projects::result_state(now, experiment, engine::registry()))},
             {"shaders", std::move(shaders)}});
    }
    return json;
}

/// How far the picture is from the kept one.
void compare_pictures(Json& row, const Image& now, const std::filesystem::path& file) {
    const auto before = read_image(file);
    row["identical"] = now.pixels == before.pixels;
    if (now.width != before.width || now.height != before.height) return;  // `changed` names the size
    const auto metrics = compute_metrics(now, before, {"rmse", "mae"});
    for (const auto& [name, value] : metrics.values) {
        row[name] = engine::number_json(value);
        if (const auto why = why_not_finite(value, name, metrics.pixels); !why.empty())
            row["reasons"][name] = why;
    }
}

/// Renders a kept result's experiment again and reports how far the pictures are apart and what changed.
void verify(Json& row, engine::Machine& machine, const projects::LoadedProject& loaded,
            const projects::Experiment& experiment, const projects::ResultIndex& index, ProgressLine& line) {
    const auto* kept = index.find(experiment.last_kept_key);
    if (!kept)
        throw InputError((loaded.folder / "results/index.json").string(), "",
                         "does not list the kept result; render it again with --keep");
    const auto inputs = projects::picture_inputs(loaded.project, experiment, engine::registry());
    row["changed"] = projects::differences(kept->inputs, inputs);
    for (const auto& file : kept->files)
        if (file.role == "main" && !file.content_hash.empty() &&
            projects::hash_file(loaded.folder / "results" / file.path) != file.content_hash)
            row["changed"].push_back("kept picture: its file was changed");
    engine::Execution execution(machine, engine::from_project(loaded.project, experiment, loaded.folder));
    graph::FrameOptions options;
    options.cancel = &engine::interruption();
    options.progress = line.callback();
    const auto report = under_progress(line, {}, [&] { return engine::run_frames(execution, options); });
    if (report.backend != kept->provenance.backend || report.device != kept->provenance.driver)
        row["changed"].push_back("device: " + kept->provenance.driver + " → " + report.device);
    if (!kept->provenance.processor.empty() && report.processor != kept->provenance.processor)
        row["changed"].push_back("processor: " + kept->provenance.processor + " → " + report.processor);
    for (const auto& file : kept->files)
        if (file.role == "main")
            compare_pictures(row, main_result(execution), loaded.folder / "results" / file.path);
}

void print_row(const Json& row) {
    std::cout << row["experiment"].get<std::string>() << "  ";
    if (row.contains("error"))
        std::cout << "error: " << row["error"].get<std::string>();
    else if (row.value("identical", false))
        std::cout << "identical";
    else
        std::cout << (row.contains("rmse") ? "rmse " + row["rmse"].dump() : "of another size");
    for (const auto& change : row["changed"]) std::cout << "  [" << change.get<std::string>() << "]";
    std::cout << "\n";
}

/// What cannot be verified is reported and keeps no other result from being verified.
int verify_all(const ProjectFlags& flags, projects::LoadedProject loaded) {
    const auto contents = projects::read_contents(loaded.project, loaded.folder, &engine::interruption());
    loaded.project = projects::with_contents(loaded.project, contents);
    const auto index = projects::ResultIndex::load(loaded.folder);
    Json json{{"project", loaded.folder.string()}, {"results", Json::array()}};
    int status = done;
    std::optional<engine::Machine> machine;
    double frames = 0;
    for (const auto& experiment : loaded.project.experiments)
        if (!experiment.last_kept_key.empty()) frames += frames_of(experiment);
    ProgressLine line(!flags.quiet, frames);
    for (const auto& experiment : loaded.project.experiments) {
        if (experiment.last_kept_key.empty()) continue;
        if (!machine) machine.emplace(machine_options(flags.machine));
        Json row{
            {"experiment", experiment.id}, {"key", experiment.last_kept_key}, {"changed", Json::array()}};
        line.begin(experiment.id, frames_of(experiment));
        try {
            verify(row, *machine, loaded, experiment, index, line);
        } catch (const Error& error) {
            row["error"] = projects::printable(error.what(), 4096);
            status = std::max(status, status_of(error));
        }
        line.clear();
        if (!flags.json) print_row(row);
        json["results"].push_back(std::move(row));
    }
    if (flags.json)
        std::cout << json.dump(2) << "\n";
    else if (json["results"].empty())
        std::cout << "no experiment has a kept result\n";
    return status;
}

/// Everything that can be said about a project without rendering.
std::vector<Message> check_all(const projects::LoadedProject& loaded) {
    const auto contents = projects::read_contents(loaded.project, loaded.folder);
    auto messages = projects::check(loaded, loaded.folder, engine::registry(), &contents);
    try {
        const auto index = projects::ResultIndex::load(loaded.folder);
        const auto missing = projects::check_results(index, loaded.folder);
        messages.insert(messages.end(), missing.begin(), missing.end());
    } catch (const InputError& error) {
        messages.insert(messages.begin(), {Severity::error, "results", error.what()});
    }
    engine::SceneCache scenes;
    const auto facts = engine::scene_facts(scenes, loaded.project, loaded.folder);
    for (const auto& [id, why] : projects::mismatched_references(loaded.project, engine::registry(), facts))
        messages.push_back({Severity::note, "project", "experiment '" + id + "' " + why});
    if (const auto recovery = projects::find_recovery(loaded.folder, engine::registry()))
        messages.push_back({Severity::warning, "project",
                            recovery->file.string() +
                                " holds changes that were never saved; open the project to take them over"});
    return messages;
}

int pack(const ProjectFlags& flags) {
    const auto messages =
        projects::pack_project(flags.project, flags.pack, engine::registry(), &engine::interruption());
    if (flags.json) {
        std::cout << Json{{"packed", flags.pack}, {"messages", to_json(messages)}}.dump(2) << "\n";
        return done;
    }
    print(messages);
    std::cout << flags.pack << " written\n";
    return done;
}

int unpack(const ProjectFlags& flags) {
    const auto folder = projects::unpack_project(flags.project, flags.unpack, &engine::interruption());
    if (flags.json)
        std::cout << Json{{"folder", folder.string()}}.dump(2) << "\n";
    else
        std::cout << folder.string() << " written\n";
    return done;
}

int run_project(const ProjectFlags& flags) {
    const auto& registry = engine::registry();
    if (!flags.pack.empty()) return pack(flags);
    if (!flags.unpack.empty()) return unpack(flags);
    if (flags.upgrade) {
        const auto changes =
            projects::upgrade_project(flags.project, registry, real_file_system(), &engine::interruption());
        flags.json ? void(std::cout << Json{{"changes", to_json(changes)}}.dump(2) << "\n") : print(changes);
        if (!flags.json && changes.empty()) std::cout << "nothing to upgrade\n";
        return done;
    }
    const auto loaded = projects::load_project(flags.project, registry);
    if (flags.prune) {
        const auto pruned =
            projects::prune_results(loaded.project, registry, loaded.folder, &engine::interruption());
        if (flags.json)
            std::cout << Json{{"keys", pruned.keys}, {"files", pruned.files}}.dump(2) << "\n";
        else
            std::cout << pruned.keys.size() << " results and " << pruned.files.size() << " files removed\n";
        return done;
    }
    if (flags.results) return list_results(loaded, flags.json);
    if (!flags.changes.empty()) return print_changes(loaded, flags.changes, flags.json);
    if (flags.verify) return verify_all(flags, loaded);
    auto json = summary(loaded);
    std::vector<Message> messages = loaded.messages;
    if (flags.check) messages = check_all(loaded);
    json["messages"] = to_json(messages);
    if (flags.json) {
        std::cout << json.dump(2) << "\n";
    } else {
        const auto name = json["name"].get<std::string>();
        std::cout << (name.empty() ? "(no name)" : name) << " (schema " << json["schema"] << ")\n";
        for (const auto& experiment : json["experiments"]) {
            std::cout << "  " << experiment["id"].get<std::string>() << "  "
                      << experiment["method"].get<std::string>()
                      << "  result: " << experiment["result"].get<std::string>() << "\n";
            for (const auto& [file, lines] : experiment["shaders"].items())
                std::cout << "    shader changed: " << file << " (" << lines.get<std::string>() << ")\n";
        }
        print(messages);
    }
    for (const auto& message : messages)
        if (flags.check && message.severity == Severity::error) return bad_input;
    return done;
}

}  // namespace

void add_project(CLI::App& app, Run& run) {
    auto flags = std::make_shared<ProjectFlags>();
    auto* command = app.add_subcommand("project", "What a project holds; checks and mends it");
    command
        ->add_option("PROJECT", flags->project,
                     "Project folder or its project.json; for --unpack the packed file")
        ->required()
        ->check(no_scene());
    auto* actions = command->add_option_group("action");
    actions->add_flag("--check", flags->check, "Look for missing or changed files, unknown keys and methods");
    actions->add_flag("--upgrade", flags->upgrade, "Rewrite with the newest schema");
    actions->add_flag("--verify", flags->verify, "Render kept results again and compare");
    actions->add_flag("--prune", flags->prune, "Remove results that no experiment needs");
    actions->add_flag("--results", flags->results, "List the kept results");
    actions
        ->add_option("--changes", flags->changes,
                     "What changed from result A to B: ids of experiments (their last kept result), "
                     "beginnings of keys, or now:ID; without B to what the experiment would give now")
        ->expected(1, 2);
    actions->add_option("--pack", flags->pack,
                        "Write the project with its scenes, images and kept results to one file");
    actions->add_option("--unpack", flags->unpack,
                        "Unpack into a new folder NAME.interreflect inside this folder");
    actions->require_option(0, 1);
    add_json_flag(*command, flags->json);
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return run_project(*flags); }; });
}

}  // namespace ir::cli
