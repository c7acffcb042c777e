// `interreflect-cli reference`: matches experiments with their ground truth and computes it.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/render_project.h"
#include "app/cli/run_and_keep.h"
#include "app/cli/run_frames.h"
#include "app/cli/shard.h"
#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "app/engine/moving.h"
#include "app/engine/picture_parts.h"
#include "app/engine/pictures.h"
#include "projects/keep.h"
#include "projects/open_project.h"
#include "projects/results.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ReferenceFlags {
    MachineFlags machine;
    std::string project, out;
    std::vector<std::string> experiments;
    std::int64_t samples = 0;
    ShardFlags shard;
    bool quiet = false, json = false;
    double checkpoint = engine::Checkpoints::usual_seconds;
};

/// What a run says of itself: samples, their rate, and what else the method declares.
std::string text_of(const engine::Execution& execution, const FrameReport& report) {
    auto text = engine::samples_text(execution, report);
    for (const auto& [key, value] : report.figures) {
        if (key == engine::rate_figure) continue;
        char figure[160];
        std::snprintf(figure, sizeof figure, ", %s %.4g", key.substr(0, 60).c_str(), value);
        text += figure;
    }
    return text;
}

class References {
  public:
    explicit References(const ReferenceFlags& flags) : flags_(flags), shard_(chosen_shard(flags.shard)) {}

    int run() {
        begin();
        for (const auto& id : ids_)
            guarded("reference '" + id + "'", [&] { shard_.count > 1 ? compute_part(id) : compute(id); });
        return end();
    }

    /// Of what shards have left.
    int merge() {
        begin();
        for (const auto& id : ids_)
            guarded("reference '" + id + "'", [&] {
                const auto& experiment = *projects::find_item(project_.experiments, id);
                const int count = engine::parts_of_picture(project_, experiment, folder_);
                if (count == 0) return compute_if_kept(id);
                join(id, {project_, experiment, folder_, count});
            });
        return end();
    }

  private:
    void begin() {
        if (!flags_.out.empty()) make_out_folder(flags_.out);
        folder_ = projects::project_folder(flags_.project);
        require_results(flags_.project, folder_);
        match_all();
        double frames = 0;
        for (const auto& id : ids_) frames += frames_of(*projects::find_item(project_.experiments, id));
        line_.emplace(!flags_.quiet, frames);
    }

    int end() const {
        if (flags_.json) std::cout << Json{{"references", rows_}}.dump(2) << "\n";
        return status_;
    }

    /// What fails keeps no other reference from being computed.
    template <class Work>
    void guarded(const std::string& what, Work work) {
        try {
            work();
        } catch (const Error& error) {
            if (line_) line_->clear();
            complain(flags_.project + ": " + what + ": " + error.what());
            status_ = std::max(status_, status_of(error));
        }
    }

    std::vector<std::string> chosen(const projects::Project& project) const {
        auto ids = flags_.experiments;
        for (const auto& id : ids) projects::experiment_of(project, id);
        if (!ids.empty()) return ids;
        if (project.experiments.empty())
            throw InputError((folder_ / projects::project_file_name).string(), "",
                             "has no experiments to match; add one");
        for (const auto& experiment : project.experiments) {
            const auto* method = engine::registry().find(experiment.method);
            if (!method || !method->is_reference) ids.push_back(experiment.id);
        }
        return ids;
    }

    engine::Machine& machine() {
        if (!machine_) machine_.emplace(machine_options(flags_.machine));
        return *machine_;
    }

    /// The document is open for writing only here, and only one command at a time has it: others that match
    /// other experiments wait, and find what this one has added.
    void match_all() {
        const projects::ResultsGuard guard(folder_);
        projects::OpenProject open(folder_, engine::registry());
        open.wait_for_files();
        const auto change = [&](projects::EditPtr edit) {
            if (!edit) return;
            if (open.is_read_only())
                throw Error("has to be matched, but the project is " + open.read_only_reason() +
                            "; match it there and save, or close it");
            open.edit(std::move(edit));
        };
        for (const auto& id : chosen(open.project()))
            guarded("experiment '" + id + "'", [&] {
                const auto facts = engine::scene_facts(machine().scenes(), open.project(), folder_);
                change(projects::match(open.project(), id, engine::registry(), facts.is_animated));
                const auto truth = projects::find_item(open.project().experiments, id)->reference;
                if (std::find(ids_.begin(), ids_.end(), truth) != ids_.end()) return;
                change(more_or_fewer_samples(open, truth));
                ids_.push_back(truth);
            });
        if (!open.is_read_only()) open.save();
        project_ = open.project();
    }

    /// Null where the reference has as many samples as are asked for.
    projects::EditPtr more_or_fewer_samples(const projects::OpenProject& open, const std::string& id) const {
        const auto& registry = engine::registry();
        const auto now = projects::with_contents(open.project(), open.contents());
        const auto& truth = *projects::find_item(now.experiments, id);
        const auto samples = static_cast<std::uint64_t>(flags_.samples);
        const auto count = projects::sample_count(truth, registry);
        // What is kept already never gets fewer.
        const bool is_kept = projects::result_state(now, truth, registry) == projects::ResultState::current;
        if (samples <= count && (samples == 0 || samples == count || is_kept)) return nullptr;
        return projects::set_sample_count(open.project(), id, samples, registry);
    }

    void compute(const std::string& id) {
        const auto experiment = *projects::find_item(project_.experiments, id);
        engine::Execution execution(machine(), engine::from_project(project_, experiment, folder_));
        auto options = frame_options(flags_.machine);
        line_->begin(id, frames_of(experiment));
        options.progress = line_->callback();
        const auto run =
            run_and_keep(execution, options, project_, experiment, folder_, flags_.checkpoint, *line_);
        print_messages(execution, run.report);
        write(execution, run.report, id);
        tell(id, execution, run);
    }

    /// One task's part. Whoever ends last joins them all.
    void compute_part(const std::string& id) {
        const auto& experiment = *projects::find_item(project_.experiments, id);
        const engine::PictureParts parts(project_, experiment, folder_, shard_.count);
        auto resolved = engine::from_project(project_, experiment, folder_);
        resolved.shard = shard_;
        engine::Execution execution(machine(), resolved);
        if (parts.is_kept(execution.samples_requested())) return compute(id);
        const auto problems = parts.resume(execution);
        KeptRun run;
        run.resumed_from = execution.samples();
        line_->begin(id, frames_of(experiment));
        auto options = frame_options(flags_.machine);
        options.progress = line_->callback();
        bool is_put_away = false;
        const auto keep = [&](const FrameReport&) {
            parts.keep(execution);
            is_put_away = true;
        };
        try {
            run.report = engine::run_frames(execution, options, {keep, flags_.checkpoint});
        } catch (const Cancelled&) {
            line_->clear();
            if (is_put_away) tell_kept(execution, id);
            throw;
        }
        line_->clear();
        for (const auto& problem : problems)
            run.report.messages.push_back({Severity::warning, "state", problem});
        if (execution.samples() > run.resumed_from) parts.keep(execution);
        print_messages(execution, run.report);
        tell(id, execution, run);
        const auto samples = execution.samples_requested();
        bool is_whole = false;
        unless_kept(parts, samples, [&] { is_whole = parts.missing(samples).empty(); });
        if (is_whole) join(id, parts);
    }

    /// False where parts went because another task, which was quicker, keeps the whole.
    template <class Work>
    static bool unless_kept(const engine::PictureParts& parts, std::uint64_t samples, Work work) {
        try {
            work();
            return true;
        } catch (const Error&) {
            if (!parts.is_kept(samples)) throw;
            return false;
        }
    }

    void join(const std::string& id, const engine::PictureParts& parts) {
        const auto& experiment = *projects::find_item(project_.experiments, id);
        engine::Execution execution(machine(), engine::from_project(project_, experiment, folder_));
        const auto samples = execution.samples_requested();
        const bool is_joined = unless_kept(parts, samples, [&] {
            if (const auto missing = parts.missing(samples); !missing.empty())
                throw Error(listed(missing) + "; run the shards that lack them");
            execution.restore(parts.joined(execution));
        });
        if (!is_joined) return;
        KeptRun run;
        run.resumed_from = execution.samples();
        auto options = frame_options(flags_.machine);
        options.wanted.push_back(execution.method().variance);
        run.report = engine::run_frames(execution, options);
        run.key = engine::keep_result(project_, experiment, folder_, execution, run.report);
        parts.remove();
        write(execution, run.report, id);
        tell(id, execution, run, "are joined");
    }

    void compute_if_kept(const std::string& id) {
        const auto& experiment = *projects::find_item(project_.experiments, id);
        const engine::Execution execution(machine(), engine::from_project(project_, experiment, folder_));
        if (!engine::PictureParts(project_, experiment, folder_, 1).is_kept(execution.samples_requested()))
            throw Error("no part of it is there; run `reference` with --shard");
        compute(id);
    }

    void write(const engine::Execution& execution, const FrameReport& report, const std::string& id) const {
        if (flags_.out.empty()) return;
        const auto stem = (fs::path(flags_.out) / id).string();
        write_exr(stem + ".exr", layers(execution, {execution.method().variance}), attributes(execution));
        write_file(stem + ".json", engine::statistics_json(execution, report) + "\n");
    }

    void tell(const std::string& id, const engine::Execution& execution, const KeptRun& run,
              const char* what_is_there = "are kept already") {
        const auto samples = execution.samples();
        const auto& shard = execution.experiment().shard;
        const bool is_part = shard.count > 1;
        const auto part = is_part
                              ? "part " + std::to_string(shard.index) + " of " + std::to_string(shard.count)
                              : run.key.substr(0, 16);
        if (!flags_.json)
            std::cout << id << "  "
                      << (samples == run.resumed_from ? std::to_string(samples) + " samples " + what_is_there
                                                      : text_of(execution, run.report))
                      << "  " << part << "\n";
        auto figures = run.report.figures;
        const double rate = figures[engine::rate_figure];
        figures.erase(engine::rate_figure);
        rows_.push_back({{"experiment", id},
                         {"key", run.key},  // of a part: empty
                         {"shard", shard.index},
                         {"shards", shard.count},
                         {"samples", samples},
                         {"resumed_from", run.resumed_from},
                         {"seconds", run.report.wall_ms / 1000},
                         {"samples_per_second", rate},
                         {"figures", figures}});
    }

    const ReferenceFlags& flags_;
    const Shard shard_;
    std::filesystem::path folder_;
    projects::Project project_;  ///< matched
    std::optional<engine::Machine> machine_;
    std::optional<ProgressLine> line_;
    std::vector<std::string> ids_;  ///< of the references
    Json rows_ = Json::array();
    int status_ = done;
};

void add_project_flags(CLI::App& command, ReferenceFlags& flags) {
    command.add_option("--experiment", flags.experiments,
                       "Id of an experiment to match; repeat for more (default: all)");
    command
        .add_option("--samples", flags.samples,
                    "Samples per pixel; references that have fewer go on (default: as the project says)")
        ->check(CLI::Range(std::int64_t{1}, max_samples));
    command.add_option("--out", flags.out, "Folder for the references as ID.exr and ID.json");
    add_quiet_flag(command, flags.quiet);
    add_json_flag(command, flags.json);
    add_machine_flags(command, flags.machine);
}

void add_reference_merge(CLI::App& reference, Run& run) {
    auto flags = std::make_shared<ReferenceFlags>();
    auto* command = reference.add_subcommand(
        "merge", "Join the parts that all shards have left in a project's results/parts");
    command->add_option("PROJECT", flags->project, "Project folder or its project.json")
        ->required()
        ->check(no_scene());
    add_project_flags(*command, *flags);
    command->callback([flags, &run] { run = [flags] { return References(*flags).merge(); }; });
}

}  // namespace

void add_reference(CLI::App& app, Run& run) {
    auto flags = std::make_shared<ReferenceFlags>();
    auto* command = app.add_subcommand(
        "reference",
        "Match a project's experiments with their ground truth, compute it and keep it; `reference merge` "
        "joins shards");
    const auto* place = command->add_option("PROJECT", flags->project, "Project folder or its project.json")
                            ->check(no_scene());
    add_project_flags(*command, *flags);
    add_checkpoint_flag(*command, flags->checkpoint);
    add_shard_flags(*command, flags->shard, "tile of each picture");
    add_reference_merge(*command, run);
    command->callback([flags, command, place, &run] {
        if (command->got_subcommand("merge")) return;
        require_places({place});
        run = [flags] { return References(*flags).run(); };
    });
}

}  // namespace ir::cli
