#include <iostream>

#include "app/cli/command.h"
#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/render_project.h"
#include "app/cli/run_and_keep.h"
#include "app/cli/run_frames.h"
#include "app/cli/temporary_folder.h"
#include "app/engine/error_study.h"
#include "app/engine/from_project.h"
#include "app/engine/interruption.h"
#include "app/engine/kept_study.h"
#include "app/engine/sweep_table.h"
#include "app/report/write_html.h"
#include "projects/pack.h"
#include "projects/results.h"
#include "projects/text.h"
#include "renderers/core/bytes_text.h"
#include "renderers/core/words.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;

struct ReportFlags {
    MachineFlags machine;
    std::string what, reference, comparison, out = "report.html", values = "auto", limit;
    std::size_t pictures = report::usual_sweep_pictures;
    bool render = false, quiet = false;
};

class ReportCommand {
  public:
    explicit ReportCommand(const ReportFlags& flags) : flags_(flags), options_(page_options(flags)) {}

    int run() {
        std::error_code ignored;
        if (!flags_.reference.empty()) return write_pair();
        if (!fs::exists(flags_.what, ignored))
            throw InputError(flags_.what, "",
                             "is not there; give a project, a sweep's folder or two pictures");
        if (fs::is_directory(flags_.what, ignored))
            return fs::exists(fs::path(flags_.what) / projects::project_file_name, ignored) ||
                           engine::sweep_lists(flags_.what).empty()
                       ? write_project(flags_.what)
                       : write_sweep();
        if (fs::path(flags_.what).filename() == projects::project_file_name)
            return write_project(flags_.what);
        if (has_picture_ending(flags_.what))
            throw UsageError("a report of '" + flags_.what + "' needs a second picture, the reference");
        if (flags_.render)
            throw UsageError("--render keeps what it renders, and '" + flags_.what +
                             "' is packed; unpack it (`project --unpack`) and report the folder");
        files_.reads("P", flags_.what);
        const TemporaryFolder folder;
        return write_project(
            projects::unpack_project(flags_.what, folder.path(), &engine::interruption()).string());
    }

  private:
    static report::PageOptions page_options(const ReportFlags& flags) {
        report::PageOptions options;
        options.values = flags.values == "half"   ? report::Values::half
                         : flags.values == "8bit" ? report::Values::bytes
                                                  : report::Values::automatic;
        if (!flags.limit.empty()) options.limit = engine::parse_bytes(flags.limit);
        return options;
    }

    report::Work work() {
        report::Work work;
        work.cancel = &engine::interruption();
        if (!flags_.quiet)
            work.progress = [this](const std::string& what, double fraction) { line_.tell(what, fraction); };
        return work;
    }

    void require_project() const {
        if (!flags_.comparison.empty()) throw UsageError("--comparison is for projects, which have some");
    }

    /// A comparison by its id or name.
    report::Subject subject_in(const projects::Project& project) const {
        report::Subject subject{flags_.comparison, {}};
        if (flags_.comparison.empty() || find_item(project.comparisons, flags_.comparison)) return subject;
        std::vector<std::string> ids;
        for (const auto& each : project.comparisons)
            if (each.name == flags_.comparison) ids.push_back(each.id);
        if (ids.size() > 1)
            throw UsageError("--comparison: several are called '" +
                             projects::printable(flags_.comparison, 60) + "'; give an id: " + listed(ids));
        if (!ids.empty()) subject.comparison = ids.front();
        return subject;
    }

    int write_pair() {
        if (flags_.render) throw UsageError("--render is for projects: two pictures are there already");
        require_project();
        files_.reads("P", flags_.what);
        files_.reads("REFERENCE", flags_.reference);
        check_out();
        line_.begin("Report", 1);
        return write(report::report_of(fs::path(flags_.what), fs::path(flags_.reference), work()));
    }

    int write_sweep() {
        if (flags_.render)
            throw UsageError("--render is for projects; `sweep PROJECT NAME --out " + flags_.what +
                             " --resume` renders what a sweep lacks");
        require_project();
        const fs::path folder = flags_.what;
        for (const auto& list : engine::sweep_lists(folder)) {
            files_.reads("P", list.string());
            for (const auto& row : engine::read_table(list).rows) {
                files_.reads("P", engine::picture_of(row, folder).string());
                files_.reads("P", engine::reference_of(row, folder).string());
            }
        }
        check_out();
        line_.begin("Report", 1);
        return write(report::report_of_sweep(flags_.what, flags_.pictures, work()));
    }

    int write_project(const std::string& project) {
        auto loaded = load_project(project);
        files_.reads(loaded);
        check_out();
        const auto subject = subject_in(loaded.project);
        int status = done;
        if (flags_.render) {
            status = render_lacking(loaded, subject);
            loaded = load_project(project);
        }
        line_.begin("Report", 1);
        return std::max(status, write(report::report_of(loaded.project, loaded.folder, work(), subject)));
    }

    void check_out() {
        files_.writes("--out", flags_.out);
        require_folder_of(flags_.out, "--out");
    }

    int write(const report::Report& made) {
        line_.begin("Writing", 1);
        const auto size = report::write_html(flags_.out, made, options_, work());
        line_.clear();
        for (const auto& lack : made.lacks) std::cerr << "note: " << lack << "\n";
        std::cout << flags_.out << "  " << bytes_text(size) << "\n";
        return done;
    }

    /// What has no kept result or a stale one, and plots likewise.
    int render_lacking(const projects::LoadedProject& loaded, const report::Subject& subject) {
        const auto now = as_on_disk(loaded);
        std::vector<const projects::Experiment*> experiments;
        for (const auto& experiment : loaded.project.experiments)
            if (takes_part(loaded.project, subject, experiment.id) &&
                projects::result_state(now, experiment, engine::registry()) != projects::ResultState::current)
                experiments.push_back(&experiment);
        std::vector<const projects::ErrorPlot*> plots;
        for (const auto& plot : loaded.project.plots)
            if (subject.comparison.empty() && is_lacking(plot, loaded)) plots.push_back(&plot);
        if (experiments.empty() && plots.empty()) return done;
        require_results(flags_.what, loaded.folder);
        engine::Machine machine(machine_options(flags_.machine));
        int status = done;
        const auto attempt = [&](const std::string& what, const auto& work) {
            line_.begin(what, 1);
            try {
                work();
            } catch (const Cancelled&) {
                throw;
            } catch (const Error& error) {
                line_.clear();
                complain(flags_.what + ": " + what + ": " + error.what());
                status = std::max(status, status_of(error));
            }
        };
        for (const auto* experiment : experiments)
            attempt("experiment '" + experiment->id + "'", [&] {
                auto options = frame_options(flags_.machine);
                options.progress = line_.callback();
                engine::Execution execution(machine,
                                            engine::from_project(loaded.project, *experiment, loaded.folder));
                run_and_keep(execution, options, loaded.project, *experiment, loaded.folder,
                             engine::Checkpoints::usual_seconds, line_);
            });
        for (const auto* plot : plots)
            attempt("plot '" + plot->id + "'", [&] {
                engine::StudyCallbacks callbacks;
                callbacks.cancel = &engine::interruption();
                callbacks.progress = line_.callback();
                callbacks.keeps_reference = true;
                callbacks.memory_budget = frame_options(flags_.machine).memory_budget;
                engine::keep_study(
                    loaded.project, *plot, loaded.folder,
                    engine::run_error_study(machine, loaded.project, *plot, loaded.folder, callbacks));
            });
        line_.clear();
        return status;
    }

    static bool is_lacking(const projects::ErrorPlot& plot, const projects::LoadedProject& loaded) {
        try {
            const auto kept = engine::load_study(loaded.folder, plot.id);
            return !kept || engine::is_stale(*kept, loaded.project, plot,
                                             projects::read_contents(loaded.project, loaded.folder));
        } catch (const InputError&) {
            return true;
        }
    }

    const ReportFlags& flags_;
    const report::PageOptions options_;
    OutputFiles files_;
    ProgressLine line_{!flags_.quiet, 2};
};

}  // namespace

void add_report(CLI::App& app, Run& run) {
    auto flags = std::make_shared<ReportFlags>();
    auto* command = app.add_subcommand(
        "report",
        "One HTML file of a project, a comparison, a sweep or two pictures, to be sent and opened in a "
        "browser");
    command
        ->add_option("P", flags->what, "Project folder or packed file, the folder of a sweep, or a picture")
        ->check(no_scene())
        ->required();
    command->add_option("REFERENCE", flags->reference, "With a picture: what it is compared with");
    command->add_option("--comparison", flags->comparison,
                        "Id or name of a comparison of the project: its two pictures alone");
    command->add_option("--out", flags->out, "The file")->capture_default_str();
    command->add_flag("--render", flags->render,
                      "Render and keep what the project lacks or has stale, pictures and plots, before");
    command
        ->add_option("--values", flags->values,
                     "Numbers under the cursor: half floats, those of the 8-bit pictures, or auto: half "
                     "floats as long as the file stays below --limit")
        ->check(CLI::IsMember({"auto", "half", "8bit"}))
        ->capture_default_str();
    command->add_option("--limit", flags->limit,
                        "Size of the file for --values auto (default: " +
                            std::to_string(report::PageOptions::usual_limit / 1'000'000) + " MB)");
    command->add_option("--pictures", flags->pictures, "Of a sweep: at most so many pictures")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return ReportCommand(*flags).run(); }; });
}

}  // namespace ir::cli
