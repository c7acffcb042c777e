#include "app/cli/run_and_keep.h"

#include <iostream>

#include "app/engine/keep_result.h"
#include "renderers/core/error.h"

namespace ir::cli {

void add_checkpoint_flag(CLI::App& command, double& seconds) {
    command
        .add_option("--checkpoint", seconds,
                    "Seconds of rendering after which what adds up is kept, so that no more is lost whatever "
                    "ends the program; 0: only when it is interrupted")
        ->check(within(0, 1e9))
        ->capture_default_str();
}

void tell_kept(const engine::Execution& execution, const std::string& id) {
    std::cerr << "interreflect-cli: kept " << execution.samples() << " of " << execution.samples_requested()
              << " samples of '" << id << "'; run it again to go on\n";
}

KeptRun run_and_keep(engine::Execution& execution, graph::FrameOptions options,
                     const projects::Project& project, const projects::Experiment& experiment,
                     const std::filesystem::path& folder, double checkpoint, const ProgressLine& line) {
    KeptRun run;
    const auto problems = engine::resume_kept(execution, project, experiment, folder);
    run.resumed_from = execution.samples();
    if (const auto& variance = execution.method().variance; !variance.empty())
        options.wanted.push_back(variance);
    const auto keep = [&](const FrameReport& report) {
        run.key.clear();
        run.key = engine::keep_result(project, experiment, folder, execution, report);
    };
    try {
        run.report = engine::run_frames(execution, options, {keep, checkpoint});
    } catch (const Cancelled&) {
        line.clear();
        if (!run.key.empty()) tell_kept(execution, experiment.id);
        throw;
    }
    line.clear();
    if (run.report.began_anew) run.resumed_from = 0;
    for (const auto& problem : problems) run.report.messages.push_back({Severity::warning, "state", problem});
    keep(run.report);
    return run;
}

}  // namespace ir::cli
