#include "app/cli/plot_project.h"
#include "app/cli/shard.h"
#include "renderers/core/limits.h"

namespace ir::cli {

namespace {

struct PlotFlags {
    ProjectPlots job;
    ShardFlags shard;
    bool quiet = false, no_keep = false;
};

void add_output_flags(CLI::App& command, PlotFlags& flags) {
    auto& job = flags.job;
    command.add_option("ID", job.plots, "Plots to carry out (default: all)");
    command.add_option("--metric", job.metric, "Metric of table and front (default: the plot's)");
    command.add_option("--json", job.json, "File for all numbers; - or nothing: standard output")
        ->expected(0, 1)
        ->default_str("-");
    command.add_option("--csv", job.csv, "File for the numbers of one plot as a table");
    command.add_option("--svg", job.svg, "File for the drawing of one plot");
    add_quiet_flag(command, flags.quiet);
    add_machine_flags(command, job.machine);
}

void set_run(const std::shared_ptr<PlotFlags>& flags, const CLI::App& command, Run& run) {
    if (command.count("--json") && flags->job.json.empty()) flags->job.json = "-";
    flags->job.keep = !flags->no_keep;
    flags->job.show_progress = !flags->quiet;
    run = [flags] {
        flags->job.shard = chosen_shard(flags->shard);
        return plot_project(flags->job);
    };
}

void add_plot_merge(CLI::App& plot, Run& run) {
    auto flags = std::make_shared<PlotFlags>();
    flags->job.merge = true;
    auto* command = plot.add_subcommand(
        "merge", "Join the points that all shards have left in a project's results/plots/parts");
    command->add_option("PROJECT", flags->job.project, "Project folder")->required()->check(no_scene());
    add_output_flags(*command, *flags);
    command->callback([flags, command, &run] { set_run(flags, *command, run); });
}

}  // namespace

void add_plot(CLI::App& app, Run& run) {
    auto flags = std::make_shared<PlotFlags>();
    auto& job = flags->job;
    auto* command = app.add_subcommand(
        "plot",
        "Carry out plots of a project: error against time, frames or a parameter (also: bench error); `plot "
        "merge` joins shards");
    const auto* place = command->add_option("PROJECT", job.project, "Project folder")->check(no_scene());
    add_output_flags(*command, *flags);
    command->add_option("--repeats", job.repeats, "Runs of which the median time counts (default 1)")
        ->check(CLI::Range(1, max_repeats));
    command->add_flag("--no-keep", flags->no_keep, "Do not store the numbers in the project's results");
    add_shard_flags(*command, flags->shard, "point (experiment, or value of one)");
    add_plot_merge(*command, run);
    command->callback([flags, command, place, &run] {
        if (command->got_subcommand("merge")) return;
        require_places({place});
        set_run(flags, *command, run);
    });
}

}  // namespace ir::cli
