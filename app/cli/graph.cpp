// `interreflect-cli graph`: the passes and buffers of a frame, drawn as a graph.
#include "app/cli/command.h"
#include "app/cli/experiment_flags.h"
#include "app/cli/output_files.h"
#include "app/cli/progress_line.h"
#include "app/cli/run_frames.h"
#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/plot/pipeline_svg.h"

namespace ir::cli {
namespace {

struct GraphFlags {
    MachineFlags machine;
    ExperimentFlags experiment;
    std::string method, scene = "builtin:cornell", out;
    std::vector<std::string> wanted;
    bool structure = false, needed = false, quiet = false;
};

int draw_graph(const GraphFlags& flags) {
    engine::registry().at(flags.method);
    if (!flags.out.ends_with(".svg")) throw UsageError("--out '" + flags.out + "' must end in .svg");
    require_folder_of(flags.out, "--out");
    OutputFiles files;
    files.reads("--scene", flags.scene);
    files.writes("--out", flags.out);
    auto project = engine::project_of(flags.scene, flags.method);
    apply(flags.experiment, project, project.experiments.front());
    engine::Machine machine(machine_options(flags.machine));
    engine::Execution execution(machine, engine::from_single(project));
    auto options = frame_options(flags.machine, flags.wanted);
    ProgressLine line(!flags.quiet, 1);
    line.begin({}, 1);
    options.progress = line.callback();
    const auto report =
        under_progress(line, flags.out, [&] { return engine::run_frames(execution, options); });
    engine::require_matches("--with", flags.wanted, report);
    auto pipeline = pipeline_of(report, {!flags.structure, !flags.needed});
    pipeline.title = execution.method().title;
    write_file(flags.out, pipeline_svg(pipeline));
    print_messages(execution, report);
    return done;
}

}  // namespace

void add_graph(CLI::App& app, Run& run) {
    auto flags = std::make_shared<GraphFlags>();
    auto* command = app.add_subcommand("graph", "The passes and buffers of a method's frame, drawn as SVG");
    command->add_option("METHOD", flags->method, method_doc)->required();
    command->add_option("--out", flags->out, "The file: .svg")->required();
    command->add_option("--scene", flags->scene, "A .gltf or .glb file, or builtin:NAME")
        ->capture_default_str();
    add_experiment_flags(*command, flags->experiment);
    command->add_option("--with", flags->wanted,
                        "Pattern of buffers that are looked at, beside the result, such as 'gbuffer.*'; "
                        "repeat it");
    command->add_flag("--needed", flags->needed, "Leave out what nobody looks at");
    command->add_flag("--structure", flags->structure,
                      "Without times and memory: the same for each run on one kind of processor");
    add_machine_flags(*command, flags->machine);
    add_quiet_flag(*command, flags->quiet);
    command->callback([flags, &run] { run = [flags] { return draw_graph(*flags); }; });
}

}  // namespace ir::cli
