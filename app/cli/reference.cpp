// `interreflect-cli reference`: matches experiments with their ground truth and computes it.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/run_frames.h"
#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "app/engine/moving.h"
#include "projects/open_project.h"
#include "projects/results.h"
#include "projects/samples.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t longest_line = 4096;

struct Flags {
    MachineFlags machine;
    std::string project, out;
    std::vector<std::string> experiments;
    std::int64_t samples = 0;
    bool quiet = false, json = false;
};

/// What a run has done so far.
struct Progress {
    std::uint64_t first = 0, samples = 0, asked = 0;
    double pixels = 0, seconds = 0;
    std::map<std::string, double> figures;  ///< that the method declared

    double samples_per_second() const {
        return seconds > 0 ? static_cast<double>(samples - first) * pixels / seconds : 0;
    }
    std::string text() const {
        char line[160];
        std::snprintf(line, sizeof line, "%llu of %llu samples, %.3g M samples/s",
                      static_cast<unsigned long long>(samples), static_cast<unsigned long long>(asked),
                      samples_per_second() / 1e6);
        std::string result = line;
        for (const auto& [key, value] : figures) {
            std::snprintf(line, sizeof line, ", %s %.4g", key.substr(0, 60).c_str(), value);
            result += line;
        }
        return result;
    }
};

/// Frames until all samples are there; a line on a terminal follows them.
FrameReport trace(engine::Execution& execution, graph::FrameOptions options, Progress& progress,
                  bool is_shown) {
    const auto start = Clock::now();
    progress.first = progress.samples = execution.samples();
    if (is_shown)
        options.progress = [&](const std::string&, double fraction) {
            const double all = static_cast<double>(execution.experiment().frames);
            std::fprintf(stderr, "\r\033[K%3.0f %% %s",
                         100 * std::min(1.0, (execution.committed_frames() + fraction) / all),
                         progress.text().c_str());
        };
    FrameReport report;
    while (!execution.is_done()) {
        report = execution.run_frame(options);
        if (report.began_anew) progress.first = 0;
        progress.samples = execution.samples();
        progress.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (!report.figures.empty()) progress.figures = report.figures;
    }
    if (is_shown) std::fprintf(stderr, "\r\033[K");
    return report;
}

class References {
  public:
    explicit References(const Flags& flags) : flags_(flags), open_(flags.project, engine::registry()) {
        if (open_.is_read_only())
            throw Error(flags.project + ": cannot keep references: " + open_.read_only_reason());
    }

    int run() {
        if (!flags_.out.empty()) make_folder(flags_.out);
        match_all();
        open_.wait_for_files();
        open_.save();
        for (const auto& id : ids_) guarded("reference '" + id + "'", [&] { compute(id); });
        if (flags_.json) std::cout << Json{{"references", rows_}}.dump(2) << "\n";
        return status_;
    }

  private:
    static void make_folder(const fs::path& folder) {
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) throw Error("--out " + folder.string() + ": cannot be created (" + error.message() + ")");
    }

    /// What fails keeps no other reference from being computed.
    template <class Work>
    void guarded(const std::string& what, Work work) {
        try {
            work();
        } catch (const Error& error) {
            std::cerr << "interreflect-cli: "
                      << projects::printable(flags_.project + ": " + what + ": " + error.what(), longest_line)
                      << "\n";
            const bool file_at_fault =
                dynamic_cast<const UsageError*>(&error) || dynamic_cast<const InputError*>(&error);
            status_ = std::max<int>(status_, file_at_fault ? bad_input : failed);
        }
    }

    std::vector<std::string> chosen() const {
        auto ids = flags_.experiments;
        for (const auto& id : ids)
            if (!projects::find_item(open_.project().experiments, id))
                throw UsageError("no experiment '" + id + "' in the project");
        if (!ids.empty()) return ids;
        if (open_.project().experiments.empty())
            throw InputError((open_.folder() / "project.json").string(), "",
                             "has no experiments to match; add one");
        for (const auto& experiment : open_.project().experiments) {
            const auto* method = engine::registry().find(experiment.method);
            if (!method || !method->is_reference) ids.push_back(experiment.id);
        }
        return ids;
    }

    engine::Machine& machine() {
        if (!machine_) machine_.emplace(machine_options(flags_.machine));
        return *machine_;
    }

    void match_all() {
        const auto& registry = engine::registry();
        for (const auto& id : chosen())
            guarded("experiment '" + id + "'", [&] {
                const auto is_animated =
                    engine::animated_scenes(machine().scenes(), open_.project(), open_.folder());
                if (auto edit = projects::match(open_.project(), id, registry, is_animated))
                    open_.edit(std::move(edit));
                const auto truth = projects::find_item(open_.project().experiments, id)->reference;
                if (std::find(ids_.begin(), ids_.end(), truth) == ids_.end()) ids_.push_back(truth);
            });
        const auto samples = static_cast<std::uint64_t>(flags_.samples);
        for (const auto& id : ids_) {
            const auto& truth = *projects::find_item(open_.project().experiments, id);
            const auto count = projects::sample_count(truth, registry);
            // What is kept already never gets fewer.
            const bool is_kept =
                projects::result_state(open_.project(), truth, registry) == projects::ResultState::current;
            if (samples > count || (samples > 0 && samples < count && !is_kept))
                open_.edit(projects::set_sample_count(open_.project(), id, samples, registry));
        }
    }

    void compute(const std::string& id) {
        const auto experiment = *projects::find_item(open_.project().experiments, id);
        const auto folder = open_.folder();
        engine::Execution execution(machine(), engine::from_project(open_.project(), experiment, folder));
        auto problems = engine::resume_kept(execution, open_.project(), experiment, folder);
        auto options = frame_options(flags_.machine, {}, 1, false);
        if (const auto& variance = execution.method().variance; !variance.empty())
            options.wanted.push_back(variance);
        Progress progress;
        progress.asked = projects::sample_count(experiment, engine::registry());
        progress.pixels = static_cast<double>(execution.experiment().width) * execution.experiment().height;
        FrameReport report;
        try {
            report = trace(execution, options, progress, !flags_.quiet && isatty(STDERR_FILENO));
        } catch (const Cancelled&) {
            keep_what_is_there(experiment, execution, options, progress);
            throw;
        }
        for (const auto& problem : problems) report.messages.push_back({Severity::warning, "state", problem});
        print_messages(execution, report);
        const auto key = engine::keep_result(open_.project(), experiment, folder, execution, report);
        open_.mark_kept(id, key);
        open_.save();
        write(execution, report, id);
        tell(id, key, progress);
    }

    /// The samples of all whole frames of a computation that somebody stopped: a next one goes on from them.
    void keep_what_is_there(const projects::Experiment& experiment, engine::Execution& execution,
                            graph::FrameOptions options, const Progress& progress) {
        if (execution.samples() <= progress.first) return;
        const auto partial = projects::with_sample_count(experiment, execution.samples(), engine::registry());
        const auto folder = open_.folder();
        // A frame that asks for no more than is there shows it.
        execution.update(engine::from_project(open_.project(), partial, folder));
        options.cancel = nullptr;
        options.progress = nullptr;
        const auto report = execution.run_frame(options);
        open_.mark_kept(experiment.id,
                        engine::keep_result(open_.project(), partial, folder, execution, report));
        open_.save();
        std::cerr << "interreflect-cli: kept " << execution.samples() << " of " << progress.asked
                  << " samples of '" << experiment.id << "'; run it again to go on\n";
    }

    void write(const engine::Execution& execution, const FrameReport& report, const std::string& id) const {
        if (flags_.out.empty()) return;
        const auto stem = (fs::path(flags_.out) / id).string();
        write_exr(stem + ".exr", execution.layers({execution.method().variance}), execution.attributes());
        write_text(stem + ".json", engine::statistics_json(report) + "\n");
    }

    void tell(const std::string& id, const std::string& key, const Progress& progress) {
        if (!flags_.json)
            std::cout << id << "  "
                      << (progress.samples == progress.first
                              ? std::to_string(progress.samples) + " samples are kept already"
                              : progress.text())
                      << "  " << key.substr(0, 16) << "\n";
        rows_.push_back({{"experiment", id},
                         {"key", key},
                         {"samples", progress.samples},
                         {"resumed_from", progress.first},
                         {"seconds", progress.seconds},
                         {"samples_per_second", progress.samples_per_second()},
                         {"figures", progress.figures}});
    }

    const Flags& flags_;
    projects::OpenProject open_;
    std::optional<engine::Machine> machine_;
    std::vector<std::string> ids_;  ///< of the references
    Json rows_ = Json::array();
    int status_ = done;
};

}  // namespace

void add_reference(CLI::App& app, Run& run) {
    auto flags = std::make_shared<Flags>();
    auto* command = app.add_subcommand(
        "reference", "Match a project's experiments with their ground truth, compute it and keep it");
    command->add_option("PROJECT", flags->project, "Project folder or its project.json")->required();
    command->add_option("--experiment", flags->experiments,
                        "Id of an experiment to match; repeat for more (default: all)");
    command
        ->add_option("--samples", flags->samples,
                     "Samples per pixel; references that have fewer go on (default: as the project says)")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}));
    command->add_option("--out", flags->out, "Folder for the references as ID.exr and ID.json");
    command->add_flag("--quiet", flags->quiet, "No progress on standard error");
    command->add_flag("--json", flags->json, "Print one JSON object");
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return References(*flags).run(); }; });
}

}  // namespace ir::cli
