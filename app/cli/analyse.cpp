#include <iostream>

#include "app/cli/complain.h"
#include "app/cli/load_project.h"
#include "app/cli/output_files.h"
#include "app/cli/run_frames.h"
#include "app/cli/text_table.h"
#include "app/engine/analysis/kept_analysis.h"
#include "projects/document_fields.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "renderers/plot/plot_svg.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using projects::Analysis;

struct AnalyseFlags {
    MachineFlags machine;
    std::string project, kind, out, csv, svg;
    std::optional<std::string> reference, output;
    std::optional<int> frames;
    std::vector<std::string> names, experiments, parameters;
    bool no_keep = false, quiet = false;
};

/// An analysis that the project does not have.
Analysis own_analysis(const AnalyseFlags& flags, const projects::Project& project) {
    if (flags.experiments.empty())
        throw UsageError("--kind asks about an experiment of the project; give its id by --experiment: " +
                         listed(words_of(project.experiments, &projects::Experiment::id)));
    auto analysis = projects::analysis_of(project, flags.kind, flags.experiments.front(), engine::registry(),
                                          flags.output.value_or(""));
    if ((flags.output || flags.frames) && !projects::find_analysis_kind(flags.kind)->takes_frames)
        throw UsageError("--output and --frames are of --kind frames; leave them out");
    analysis.frames = flags.frames.value_or(analysis.frames);
    analysis.id = flags.kind;
    if (flags.experiments.size() > 1)
        analysis.experiments = flags.experiments;
    else if (analysis.experiments.size() > 1 && !flags.quiet)
        complain("note: asks about " + listed(analysis.experiments) +
                 "; choose by more than one --experiment");
    if (flags.reference) analysis.reference = *flags.reference;
    analysis.parameters = flags.parameters;
    return analysis;
}

std::vector<Analysis> chosen_analyses(const AnalyseFlags& flags, const projects::Project& project) {
    if (!flags.kind.empty() && !flags.names.empty())
        throw UsageError("give the ids of analyses, or --kind, not both");
    if (!flags.kind.empty()) return {own_analysis(flags, project)};
    if (project.analyses.empty())
        throw UsageError(
            "the project has no analyses; ask by --kind and --experiment, or add one in the window");
    if (flags.names.empty()) return project.analyses;
    std::vector<Analysis> chosen;
    for (const auto& name : flags.names) {
        const auto* found = find_item(project.analyses, name);
        for (const auto& each : project.analyses)
            if (!found && each.name == name) found = &each;
        if (!found)
            throw UsageError("no analysis '" + name + "' in the project" +
                             known_are(name, words_of(project.analyses, &Analysis::id)));
        chosen.push_back(*found);
    }
    return chosen;
}

void print(const Analysis& analysis, const engine::AnalysisResult& result) {
    const auto& data = result.data;
    std::cout << analysis.id << ": " << data.title << "\n";
    std::vector<std::vector<std::string>> rows{data.headings};
    std::set<std::size_t> numbers;
    for (const auto& [point, series] : data.in_reading_order()) {
        rows.emplace_back();
        for (std::size_t i = 0; i < point->cells.size(); ++i) {
            rows.back().push_back(point->cells[i].text);
            if (point->cells[i].number) numbers.insert(i);
        }
    }
    print_table(std::cout, rows, numbers);
    for (const auto* lines : {&data.problems, &data.notes})
        for (const auto& line : *lines) std::cout << "note: " << line << "\n";
}

class AnalyseCommand {
  public:
    explicit AnalyseCommand(const AnalyseFlags& flags)
        : flags_(flags),
          loaded_(load_project(flags.project)),
          analyses_(chosen_analyses(flags, loaded_.project)),
          keeps_(flags.kind.empty() && !flags.no_keep) {}

    int run() {
        prepare();
        engine::Machine machine(machine_options(flags_.machine));
        ProgressLine line(!flags_.quiet, double(analyses_.size()));
        for (const auto& analysis : analyses_) {
            line.begin(analysis.id, 1);
            try {
                answer(machine, analysis, line);
            } catch (const Error& error) {
                line.clear();
                complain(flags_.project + ": " + with_name(analysis, error.what()));
                status_ = std::max(status_, status_of(error));
            }
        }
        return status_;
    }

  private:
    void prepare() const {
        // Several may go on without one of them; one that has no answer ends before anything is done.
        const auto& first = analyses_.front();
        const auto why_not = projects::why_not_analysed(loaded_.project, first, engine::registry());
        if (analyses_.size() == 1 && !why_not.empty())
            throw InputError(flags_.project, "", with_name(first, why_not));
        OutputFiles files;
        files.reads(loaded_);
        for (const auto& [option, file] : {std::pair("--csv", flags_.csv), std::pair("--svg", flags_.svg)}) {
            if (file.empty()) continue;
            if (analyses_.size() > 1)
                throw UsageError(std::string(option) + " holds one analysis; give its id behind the project");
            files.writes(option, file);
            require_folder_of(file, option);
        }
        if (!flags_.out.empty()) {
            for (const auto& analysis : analyses_)
                for (const char* file : {projects::analysis_file, projects::analysis_pictures})
                    files.writes("--out", (out_of(analysis) / file).string());
            make_out_folder(flags_.out);
        }
        if (keeps_) require_results(flags_.project, loaded_.folder);
    }

    fs::path out_of(const Analysis& analysis) const {
        return analyses_.size() > 1 ? fs::path(flags_.out) / analysis.id : fs::path(flags_.out);
    }

    static std::string with_name(const Analysis& analysis, const std::string& line) {
        const auto own = "analysis '" + analysis.id + "'";
        return line.starts_with(own) ? line : own + ": " + line;
    }

    void answer(engine::Machine& machine, const Analysis& analysis, ProgressLine& line) const {
        const auto frame = frame_options(flags_.machine);
        engine::AnalysisCallbacks told;
        told.cancel = frame.cancel;
        told.memory_budget = frame.memory_budget;
        told.progress = line.callback();
        const auto result = under_progress(line, "the answer of " + analysis.id, [&] {
            return engine::run_analysis(machine, loaded_.project, analysis, loaded_.folder, told);
        });
        if (keeps_) engine::keep_analysis(loaded_.project, analysis, loaded_.folder, result);
        if (!flags_.out.empty())
            engine::write_analysis(loaded_.project, analysis, loaded_.folder, result, out_of(analysis));
        if (!flags_.csv.empty()) write_file(flags_.csv, engine::analysis_csv(result.data));
        if (!flags_.svg.empty())
            write_file(flags_.svg,
                       plot_svg(result.data, plot_svg_width, plot_svg_height_of(result.data), true));
        print(analysis, result);
    }

    const AnalyseFlags& flags_;
    const projects::LoadedProject loaded_;
    const std::vector<Analysis> analyses_;
    const bool keeps_;
    int status_ = done;
};

}  // namespace

void add_analyse(CLI::App& app, Run& run) {
    auto flags = std::make_shared<AnalyseFlags>();
    auto* command = app.add_subcommand(
        "analyse",
        "Answer questions about a project's experiments: who disagrees, what matters, what makes a "
        "difference, which stage owns the error, where two machines part, what the last frames were");
    command->add_option("PROJECT", flags->project, "Project folder")->check(no_scene())->required();
    command->add_option("ID", flags->names, "Id or name of analyses of the project (default: all)");
    const auto& fields = projects::analysis_fields();
    const auto kinds = words_of(projects::analysis_kinds(), &projects::AnalysisKind::key);
    auto* kind =
        command->add_option("--kind", flags->kind,
                            "Ask a question that the project does not have: " + listed(kinds) + "; not kept");
    command
        ->add_option("--experiment", flags->experiments,
                     "Id of an experiment that --kind asks about; may be repeated")
        ->needs(kind);
    command
        ->add_option(
            "--reference", flags->reference,
            "Id of the experiment or image that --kind judges by (default: the experiment's; '': none)")
        ->needs(kind);
    command
        ->add_option(
            "--parameter", flags->parameters,
            std::string("Key of a parameter that takes part in --kind; may be repeated (default: all). Of "
                        "divergence a machine: ") +
                projects::machine_words + " (default: gl and host)")
        ->needs(kind);
    command
        ->add_option("--output", flags->output,
                     projects::field_of(fields, "output").text.doc + " (default: the main result)")
        ->needs(kind);
    command->add_option("--frames", flags->frames, projects::field_of(fields, "frames").text.doc)
        ->check(CLI::Range(projects::min_analysis_frames, projects::max_analysis_frames))
        ->needs(kind);
    command->add_option("--out", flags->out,
                        "Folder for " + std::string(projects::analysis_file) + " and " +
                            projects::analysis_pictures + ", with a layer for each picture");
    command->add_option("--csv", flags->csv, "File for the table of one analysis");
    command->add_option("--svg", flags->svg, "File for the chart of one analysis");
    command->add_flag("--no-keep", flags->no_keep, "Do not store the answers in the project's results");
    add_quiet_flag(*command, flags->quiet);
    add_machine_flags(*command, flags->machine);
    command->callback([flags, &run] { run = [flags] { return AnalyseCommand(*flags).run(); }; });
}

}  // namespace ir::cli
