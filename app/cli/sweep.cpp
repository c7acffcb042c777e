#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <optional>

#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/plan_sweep.h"
#include "app/cli/render_project.h"
#include "app/cli/run_frames.h"
#include "app/cli/shard.h"
#include "app/engine/pictures.h"
#include "app/engine/sweep_job.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using engine::SweepRow, engine::SweepTable;

struct SweepFlags {
    MachineFlags machine;
    std::string project, name, out, json, csv, samples;
    std::vector<std::string> dumps;
    ShardFlags shard;
    std::optional<int> repeats;
    bool is_judged = false, keep = false, resume = false, quiet = false;
    std::size_t probes = 0;  ///< of a plan; 0: as many as are enough

    bool has_pictures() const { return keep || !is_judged; }
};

const projects::Sweep& chosen_sweep(const projects::Project& project, const std::string& name) {
    if (const auto* sweep = find_item(project.sweeps, name)) return *sweep;
    for (const auto& sweep : project.sweeps)
        if (sweep.name == name) return sweep;
    throw UsageError("no sweep '" + name + "' in the project" +
                     known_are(name, words_of(project.sweeps, &projects::Sweep::id)));
}

/// The value of --reference, which may be left out: 0.
std::uint64_t parse_samples(const std::string& text) {
    std::int64_t samples = 0;
    const auto* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, samples);
    if (!text.empty() &&
        (result.ec != std::errc{} || result.ptr != end || samples < 1 || samples > max_samples))
        throw UsageError("--reference '" + text + "': give a number of samples from 1 to " +
                         std::to_string(max_samples) + ", or none");
    return static_cast<std::uint64_t>(samples);
}

int repeats_of(const SweepFlags& flags) {
    return flags.repeats.value_or(engine::usual_repeats(flags.is_judged));
}

std::vector<projects::SweepPoint> points_of(const SweepFlags& flags, const projects::Project& project,
                                            const projects::Sweep& sweep) {
    try {
        return projects::sweep_points(project, sweep, engine::registry());
    } catch (const UsageError& error) {  // the project says it, not the command line
        throw InputError(flags.project, "", error.what());
    }
}

int plan(const SweepFlags& flags, bool as_json) {
    const auto loaded = load_project(flags.project);
    const auto& sweep = chosen_sweep(loaded.project, flags.name);
    SweepPlan plan{flags.machine, loaded, points_of(flags, loaded.project, sweep), {}};
    plan.options.is_judged = flags.is_judged;
    plan.options.samples = parse_samples(flags.samples);
    plan.options.repeats = repeats_of(flags);
    plan.options.frame = frame_options(flags.machine, flags.dumps);
    plan.has_pictures = flags.has_pictures();
    plan.dumps = flags.dumps;
    plan.probes = flags.probes;
    plan.as_json = as_json;
    plan.is_quiet = flags.quiet;
    return plan_sweep(std::move(plan));
}

class SweepCommand {
  public:
    explicit SweepCommand(const SweepFlags& flags)
        : flags_(flags),
          shard_(chosen_shard(flags.shard)),
          samples_(parse_samples(flags.samples)),
          repeats_(repeats_of(flags)),
          loaded_(load_project(flags.project)) {}

    int run() {
        const auto& sweep = chosen_sweep(loaded_.project, flags_.name);
        const auto job = job_of(sweep);
        const auto points = points_of(flags_, loaded_.project, sweep);
        OutputFiles files;
        files.reads(loaded_);
        for (const auto& file : {job.list(), job.lines()}) files.writes("--out", file.string());
        if (flags_.has_pictures())
            for (const auto& point : part_of(points, shard_))
                for (const char* extension : {".exr", ".png", ".json"})
                    files.writes("--out",
                                 (fs::path(flags_.out) / (point.experiment.id + extension)).string());
        files.writes("--json", json_);
        files.writes("--csv", csv_);
        make_out_folder(flags_.out);
        if (!flags_.json.empty() && flags_.json != "-") require_folder_of(flags_.json, "--json");
        if (!flags_.csv.empty()) require_folder_of(flags_.csv, "--csv");
        engine::Machine machine(machine_options(flags_.machine));
        render(machine, job, points);
        tell();
        return status_;
    }

  private:
    engine::SweepJob job_of(const projects::Sweep& sweep) const {
        engine::SweepJob job;
        job.project = loaded_.project;
        job.folder = loaded_.folder;
        job.sweep = sweep;
        job.out = flags_.out;
        job.shard = shard_;
        job.is_judged = flags_.is_judged;
        job.samples = samples_;
        job.repeats = repeats_;
        job.has_pictures = flags_.has_pictures();
        job.resumes = flags_.resume;
        job.dumps = flags_.dumps;
        return job;
    }

    double work_of(const projects::SweepPoint& point) const {
        return frames_of(point.experiment) * (1 + repeats_);
    }

    engine::SweepCallbacks callbacks(const std::vector<projects::SweepPoint>& points) {
        engine::SweepCallbacks told;
        told.frame = frame_options(flags_.machine, flags_.dumps);
        if (!flags_.quiet)
            told.frame.progress = [this](const std::string& what, double part) { line_->tell(what, part); };
        told.note = [this](const std::string& note) {
            line_->clear();
            std::cerr << "note: " << note << "\n";
        };
        told.planned = [this, part = part_of(points, shard_)](const SweepTable& table, std::size_t resumed) {
            if (resumed > 0 && !flags_.quiet)
                std::cerr << "interreflect-cli: " << resumed << " of " << table.rows.size()
                          << " variations are there already\n";
            double work = 0;
            for (std::size_t i = 0; i < part.size(); ++i)
                if (!table.rows[i].is_done()) work += work_of(part[i]);
            line_.emplace(!flags_.quiet, work);
        };
        told.begun = [this](std::size_t, const projects::SweepPoint& point) {
            line_->begin(point.experiment.id, work_of(point));
        };
        told.seen = [this](const engine::Execution& execution, const FrameReport& report) {
            engine::require_matches("--dump", flags_.dumps, report);
            line_->clear();
            print_messages(execution, report);
        };
        // What goes wrong stands in the row.
        told.ended = [this](std::size_t, const SweepRow& row, bool was_refused) {
            line_->clear();
            if (row.is_done()) return print(row);
            complain(row.id + ": " + row.problem);
            status_ = std::max(status_, was_refused ? int{bad_input} : int{failed});
        };
        return told;
    }

    void render(engine::Machine& machine, const engine::SweepJob& job,
                const std::vector<projects::SweepPoint>& points) {
        try {
            engine::run_sweep(machine, job, points, callbacks(points), table_);
        } catch (const Cancelled&) {
            if (!line_) throw;
            line_->clear();
            const auto done = std::count_if(table_.rows.begin(), table_.rows.end(),
                                            [](const SweepRow& row) { return row.is_done(); });
            std::cerr << "interreflect-cli: rendered " << done << " of " << table_.rows.size()
                      << " variations; " << job.list().string()
                      << " lists which, and --resume renders the others\n";
            throw;
        }
    }

    void print(const SweepRow& row) const {
        auto& stream = flags_.json == "-" ? std::cerr : std::cout;
        stream << row.id << "  ";
        if (!row.image.empty()) stream << (fs::path(flags_.out) / row.image).string() << "  ";
        stream << static_cast<long>(row.cold_ms) << " ms";
        if (row.warm_ms) stream << ", warm " << static_cast<long>(*row.warm_ms) << " ms";
        if (const auto error = row.errors.find("rmse"); error != row.errors.end())
            stream << ", rmse " << error->second;
        stream << "\n";
    }

    void tell() const {
        if (flags_.json == "-")
            std::cout << engine::table_json(table_);
        else if (!json_.empty())
            write_file(json_, engine::table_json(table_));
        if (!csv_.empty()) write_file(csv_, engine::table_csv(table_));
    }

    const SweepFlags& flags_;
    const Shard shard_;
    const std::uint64_t samples_;
    const int repeats_;
    const std::string json_ = file_of_shard(flags_.json, shard_), csv_ = file_of_shard(flags_.csv, shard_);
    const projects::LoadedProject loaded_;
    SweepTable table_;
    std::optional<ProgressLine> line_;
    int status_ = done;
};

struct MergeFlags {
    std::vector<std::string> folders;
    std::string out, csv;
};

int merge(const MergeFlags& flags) {
    OutputFiles files;
    for (const auto& folder : flags.folders)
        for (const auto& list : engine::sweep_lists(folder))
            if (list.stem() != engine::table_name({})) files.reads("DIR", list.string());
    files.writes("--out", flags.out);
    files.writes("--csv", flags.csv);
    const auto table = engine::merged_tables({flags.folders.begin(), flags.folders.end()},
                                             fs::absolute(flags.out).parent_path());
    require_folder_of(flags.out, "--out");
    if (!flags.csv.empty()) require_folder_of(flags.csv, "--csv");
    write_file(flags.out, engine::table_json(table));
    if (!flags.csv.empty()) write_file(flags.csv, engine::table_csv(table));
    const auto open = std::count_if(table.rows.begin(), table.rows.end(),
                                    [](const SweepRow& row) { return !row.is_done(); });
    if (open == 0) return done;
    complain(std::to_string(open) + " of " + std::to_string(table.rows.size()) +
             " variations have no result; " + flags.out + " says why");
    return failed;
}

void add_sweep_merge(CLI::App& sweep, Run& run) {
    auto flags = std::make_shared<MergeFlags>();
    auto* command = sweep.add_subcommand("merge", "Join the lists of all shards of a sweep");
    command->add_option("DIR", flags->folders, "Folders that the shards were rendered to")->required();
    command->add_option("--out", flags->out, "File for the list, as one machine would have written it")
        ->required();
    command->add_option("--csv", flags->csv, "File for the list as a table");
    command->callback([flags, &run] { run = [flags] { return merge(*flags); }; });
}

/// What decides how long a variation takes.
CLI::Option* add_work_flags(CLI::App& command, SweepFlags& flags) {
    auto* reference =
        command
            .add_option("--reference", flags.samples,
                        "Measure the error of each variation against its ground truth, of so many "
                        "samples (default: as Match has it); pictures are written with --keep alone")
            ->expected(0, 1);
    command
        .add_option("--repeats", flags.repeats,
                    "Warm runs of each variation after the first, whose median time is told apart from the "
                    "first's (default: " +
                        std::to_string(engine::usual_repeats(true)) + " with --reference, else " +
                        std::to_string(engine::usual_repeats(false)) + ")")
        ->check(CLI::Range(0, max_repeats));
    command.add_flag("--keep", flags.keep, "Write the pictures with --reference, too");
    command.add_option("--dump", flags.dumps, "Pattern of buffers to write as layers, such as 'gbuffer.*'");
    return reference;
}

void add_sweep_plan(CLI::App& sweep, Run& run) {
    auto flags = std::make_shared<SweepFlags>();
    auto* command = sweep.add_subcommand(
        "plan", "Measure some variations and tell what all take: time, disk and memory; nothing is kept");
    command->add_option("PROJECT", flags->project, "Project folder")->check(no_scene())->required();
    command->add_option("NAME", flags->name, "Id or name of the sweep")->required();
    command->add_option("--probes", flags->probes, "How many to measure (default: as many as are enough)")
        ->check(CLI::Range(std::size_t{1}, projects::max_sweep_points));
    const auto* reference = add_work_flags(*command, *flags);
    auto as_json = std::make_shared<bool>(false);
    add_json_flag(*command, *as_json);
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, reference, as_json, &run] {
        flags->is_judged = reference->count() > 0;
        run = [flags, as_json] { return plan(*flags, *as_json); };
    });
}

}  // namespace

void add_sweep(CLI::App& app, Run& run) {
    auto flags = std::make_shared<SweepFlags>();
    auto* command = app.add_subcommand(
        "sweep",
        "Render all variations of a project's sweep; `sweep plan` tells what they take, `sweep merge` joins "
        "shards");
    const auto* project = command->add_option("PROJECT", flags->project, "Project folder")->check(no_scene());
    const auto* name = command->add_option("NAME", flags->name, "Id or name of the sweep");
    const auto* out = command->add_option(
        "--out", flags->out,
        "Folder for ID-0001.exr, …, the list sweep.json, and sweep.jsonl with a line for each variation as it "
        "ends; required without `plan` and `merge`");
    const auto* reference = add_work_flags(*command, *flags);
    command->add_flag("--resume", flags->resume,
                      "Render only what --out lacks: what failed, what was not reached, and what would be "
                      "another picture now");
    add_shard_flags(*command, flags->shard, "variation");
    command->add_option("--json", flags->json, "File for the list, too; - or nothing: standard output")
        ->expected(0, 1)
        ->default_str("-");
    command->add_option("--csv", flags->csv, "File for the list as a table");
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    add_sweep_merge(*command, run);
    add_sweep_plan(*command, run);
    command->callback([flags, command, reference, project, name, out, &run] {
        if (!command->get_subcommands().empty()) return;
        require_places({project, name, out});
        if (command->count("--json") && flags->json.empty()) flags->json = "-";
        flags->is_judged = reference->count() > 0;
        run = [flags] { return SweepCommand(*flags).run(); };
    });
}

}  // namespace ir::cli
