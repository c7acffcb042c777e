#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <string>

#include "app/engine/machine_settings.h"
#include "projects/fields.h"
#include "projects/scene_files.h"

namespace ir::cli {

using engine::add_machine_flags, engine::add_outside_flag, engine::machine_options, engine::parse_bytes,
    engine::MachineFlags;

/// The contract with scripts; engine::interruption_status() where a signal ended the work.
enum ExitStatus { done = 0, failed = 1, wrong_usage = 2, bad_input = 3, limit_exceeded = 4 };

/// What each status means, for the manual.
struct ExitStatusText {
    const char *value, *doc;
};
const std::vector<ExitStatusText>& exit_statuses();

/// Each adds its subcommand; the chosen one's callback stores what main runs after parsing.
using Run = std::function<int()>;
void add_info(CLI::App& app, Run& run);
void add_list(CLI::App& app, Run& run);
void add_describe(CLI::App& app, Run& run);
void add_scene(CLI::App& app, Run& run);
void add_render(CLI::App& app, Run& run);
void add_film(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_profile(CLI::App& app, Run& run);
void add_rerun(CLI::App& app, Run& run);
void add_diff(CLI::App& app, Run& run);
void add_project(CLI::App& app, Run& run);
void add_reference(CLI::App& app, Run& run);
void add_plot(CLI::App& app, Run& run);
void add_analyse(CLI::App& app, Run& run);
void add_sweep(CLI::App& app, Run& run);
void add_report(CLI::App& app, Run& run);
void add_figure(CLI::App& app, Run& run);
void add_graph(CLI::App& app, Run& run);
void add_diverge(CLI::App& app, Run& run);
void add_bench(CLI::App& app, Run& run);
void add_schema(CLI::App& app, Run& run);
void add_submit(CLI::App& app, Run& run);
void add_tev(CLI::App& app, Run& run);
void add_thumbnail(CLI::App& app, Run& run);
void add_shell(CLI::App& app, Run& run);

/// Options and words that several commands have.
inline void add_quiet_flag(CLI::App& command, bool& quiet) {
    command.add_flag("--quiet", quiet, "No progress on standard error");
}
inline void add_json_flag(CLI::App& command, bool& json) {
    command.add_flag("--json", json, "Print one JSON object");
}
/// Of an argument that is a project: says how a scene is given.
inline CLI::Validator no_scene() {
    return {[](std::string& text) {
                if (!projects::names_scene(text)) return std::string();
                return text + " is a scene and no project; give it by --scene: render --scene " + text +
                       " --method METHOD";
            },
            ""};
}
inline constexpr const char* method_doc = "Id, as `list` prints it";

/// For a command with subcommands. CLI11 would take a subcommand's name for the value of a required place, so
/// places are declared optional, and the command's own callback demands them by this.
inline void require_places(std::initializer_list<const CLI::Option*> places) {
    for (const auto* place : places)
        if (place->count() == 0) throw CLI::RequiredError(place->get_name());
}

/// As CLI::Range, which lets NaN pass.
inline CLI::Validator within(double min, double max) {
    const CLI::Range range(min, max);
    return {[range](std::string& text) {
                if (std::isnan(std::strtod(text.c_str(), nullptr))) return text + " is not a number";
                return range(text);
            },
            range.get_description()};
}

/// The range of a document's number.
inline CLI::Validator within(const projects::FieldText& text) {
    return within(text.range.min, text.range.max);
}
inline CLI::Validator whole_within(const projects::FieldText& text) {
    return CLI::Range(static_cast<int>(text.range.min), static_cast<int>(text.range.max));
}

}  // namespace ir::cli
