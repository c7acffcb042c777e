// `interreflect-cli film`: pictures of an experiment over time, and a video of them.
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/cli/temporary_folder.h"
#include "app/engine/film.h"
#include "app/engine/from_project.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::cli {
namespace {

struct FilmFlags {
    MachineFlags machine;
    ExperimentFlags experiment;
    std::string project, chosen, scene, method;
    engine::Film film;
    bool quiet = false;
};

projects::Experiment& experiment_of(projects::Project& project, const std::string& id) {
    auto& all = project.experiments;
    if (id.empty() && all.size() == 1) return all.front();
    if (id.empty())
        throw UsageError("give --experiment" + known_are(id, words_of(all, &projects::Experiment::id)));
    projects::experiment_of(project, id);
    return *projects::find_item(all, id);
}

/// The project of the command line, or one of its scene and method.
projects::LoadedProject loaded_of(const FilmFlags& flags) {
    const bool has_scene = !flags.scene.empty() && !flags.method.empty();
    if (flags.project.empty() != has_scene ||
        (!flags.project.empty() && !(flags.scene + flags.method).empty()))
        throw UsageError("give a PROJECT, or --scene and --method");
    if (!has_scene) return load_project(flags.project);
    projects::LoadedProject loaded;
    loaded.project = engine::project_of(flags.scene, flags.method);
    return loaded;
}

int make_film(const FilmFlags& flags) {
    auto loaded = loaded_of(flags);
    auto& experiment = experiment_of(loaded.project, flags.chosen);
    apply(flags.experiment, loaded.project, experiment);
    const engine::FilmSubject subject{loaded.project, experiment, loaded.folder};
    const auto& film = flags.film;
    const bool is_video = engine::is_video(film.out);
    if (!is_video && film.out.has_extension() && !std::filesystem::is_directory(film.out))
        throw UsageError("--out '" + film.out.string() + "' must be a folder, or a video that ends in " +
                         engine::video_endings);
    OutputFiles files;
    if (!flags.project.empty()) files.reads(loaded);
    files.reads("--scene", flags.scene);
    if (is_video) {
        files.writes("--out", film.out.string());
        require_folder_of(film.out.string(), "--out");
    }
    engine::Machine machine(machine_options(flags.machine));
    const int pictures = engine::check_film(machine, subject, film);
    std::optional<TemporaryFolder> temporary;
    if (is_video)
        temporary.emplace();
    else
        make_out_folder(film.out);
    auto options = frame_options(flags.machine);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    options.progress = line.callback();
    const auto report = under_progress(line, is_video ? film.out.string() : std::string(), [&] {
        return engine::make_film(machine, subject, film, is_video ? temporary->path() : film.out, options);
    });
    print_messages(report.messages);
    const auto run = projects::effective(experiment);
    print_messages(notes_of(flags.experiment, run.method, run.values));
    std::cout << film.out.string() << "  " << pictures << " pictures  " << long(report.wall_ms) << " ms\n";
    return done;
}

}  // namespace

void add_film(CLI::App& app, Run& run) {
    auto flags = std::make_shared<FilmFlags>();
    auto* command =
        app.add_subcommand("film", "Pictures of an experiment over time, 30 a second, or a video of them");
    command
        ->add_option("PROJECT", flags->project, "Project folder; or leave out and give --scene and --method")
        ->check(no_scene());
    command->add_option("--experiment", flags->chosen, "Id of the experiment (default: the only one)");
    command->add_option("--scene", flags->scene, "A .gltf or .glb file, or builtin:NAME");
    command->add_option("--method", flags->method, method_doc);
    command
        ->add_option(
            "--out", flags->film.out,
            std::string("Folder, which gets 0001.png, 0002.png, …; or a video, which ffmpeg makes (") +
                engine::video_endings + ")")
        ->required();
    command
        ->add_option("--until", flags->film.until,
                     "Seconds of the last picture (default: as long as something moves); the first is that "
                     "of --time")
        ->check(within(1e-3, 1e6));
    command
        ->add_option("--turntable", flags->film.turntable,
                     "Seconds in which the camera turns once about its target")
        ->check(within(1e-3, 1e4));
    command->add_option("--exposure", flags->film.exposure, "Stops")->check(within(-40, 40));
    add_experiment_flags(*command, flags->experiment);
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return make_film(*flags); }; });
}

}  // namespace ir::cli
