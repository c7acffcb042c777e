#include "app/cli/command_line.h"

#include <algorithm>
#include <csignal>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/complain.h"
#include "app/engine/interruption.h"
#include "app/engine/run_frames.h"
#include "app/engine/version.h"
#include "renderers/core/reason.h"
#include "renderers/core/words.h"
#include "renderers/image/exr.h"

namespace ir::cli {
namespace {

int fail(const std::string& line, int status) {
    complain(line);
    return status;
}

/// Commands that write nothing have nothing to put away: signals end them as if they were not watched.
bool writes(const CLI::App& app) {
    for (const char* name :
         {"info", "list", "describe", "scene", "diff", "diverge", "tev", "schema", "completion", "manual"})
        if (app.got_subcommand(name)) return false;
    if (!app.got_subcommand("project")) return true;
    const auto& project = *app.get_subcommand("project");
    for (const char* action : {"--pack", "--unpack", "--prune", "--upgrade", "--verify"})
        if (project.count(action) > 0) return true;
    return false;
}

/// For the first option that the chosen command does not have.
std::string suggestion(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> known;
    for (const auto* command : app.get_subcommands())
        for (const auto* option : command->get_options()) known.push_back("--" + option->get_single_name());
    for (int i = 1; i < argc; ++i) {
        std::string word = argv[i];
        word.resize(std::min(word.size(), word.find('=')));
        if (word.rfind("--", 0) == 0 && std::find(known.begin(), known.end(), word) == known.end())
            return did_you_mean(word, known);
    }
    return {};
}

/// Whether some command has an option of this name that a value follows.
bool takes_value(const CLI::App& app, const std::string& word) {
    for (const auto* command : app.get_subcommands({})) {
        const auto* option = command->get_option_no_throw(word);
        if ((option && option->get_expected_min() > 0) || takes_value(*command, word)) return true;
    }
    return false;
}

/// CLI11 looks for ever for what an empty word means that is no option's value, where options are in groups.
void refuse_empty_words(const CLI::App& app, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!words[i].empty()) continue;
        const bool is_value = i > 0 && words[i - 1].rfind('-', 0) == 0 && takes_value(app, words[i - 1]);
        if (is_value) continue;
        throw UsageError("word " + std::to_string(i + 1) + " of the command line is empty" +
                         (i > 0 ? " (after '" + words[i - 1] + "')" : "") + "; is a variable not set?");
    }
}

void add_commands(CLI::App& app, Run& run) {
    add_info(app, run);
    add_list(app, run);
    add_describe(app, run);
    add_scene(app, run);
    add_render(app, run);
    add_film(app, run);
    add_compare(app, run);
    add_profile(app, run);
    add_rerun(app, run);
    add_diff(app, run);
    add_project(app, run);
    add_reference(app, run);
    add_plot(app, run);
    add_sweep(app, run);
    add_analyse(app, run);
    add_report(app, run);
    add_figure(app, run);
    add_graph(app, run);
    add_diverge(app, run);
    add_bench(app, run);
    add_submit(app, run);
    add_tev(app, run);
    add_thumbnail(app, run);
    add_schema(app, run);
    add_shell(app, run);
}

}  // namespace

struct CommandCheck::Commands {
    CLI::App app;
    Run run;
};

CommandCheck::CommandCheck() : commands_(std::make_unique<Commands>()) {
    commands_->app.require_subcommand(1);
    add_commands(commands_->app, commands_->run);
}

CommandCheck::~CommandCheck() = default;

void CommandCheck::operator()(std::vector<std::string> words) {
    auto& app = commands_->app;
    refuse_empty_words(app, words);
    std::reverse(words.begin(), words.end());
    try {
        app.parse(words);
    } catch (const CLI::ExtrasError&) {
        throw UsageError("not expected: " + listed(app.remaining(true)));
    }
}

int run_command_line(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error with a line, as a full disk is
    CLI::App app{
        "Interreflect on the command line: renders, compares and checks experiments without a window."};
    app.set_version_flag("--version", "interreflect-cli " + engine::version_and_commit());
    app.require_subcommand(1);
    Run run;
    try {
        add_commands(app, run);
        refuse_empty_words(app, {argv + std::min(argc, 1), argv + argc});
        app.parse(argc, argv);
        if (writes(app)) engine::watch_interruptions();
        use_threads_for_exr();
        const int status = run();
        std::cout.flush();
        if (!std::cout) return fail("standard output cannot be written", failed);
        return status;
    } catch (const CLI::Success& shown) {
        return app.exit(shown);
    } catch (const CLI::RequiredError& error) {
        std::vector<std::string> commands;
        for (const auto* command : app.get_subcommands({})) commands.push_back(command->get_name());
        if (argc == 1) return fail("give a command; --help lists them", wrong_usage);
        if (argv[1][0] != '-' && std::find(commands.begin(), commands.end(), argv[1]) == commands.end())
            return fail(std::string("unknown command '") + argv[1] + "'" + known_are(argv[1], commands),
                        wrong_usage);
        return fail(std::string(error.what()) + " (--help lists what is allowed)", wrong_usage);
    } catch (const CLI::ExtrasError&) {
        return fail("not expected: " + listed(app.remaining(true)) + suggestion(app, argc, argv) +
                        "; --help lists what is allowed",
                    wrong_usage);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + " (--help lists what is allowed)", wrong_usage);
    } catch (const InputError& error) {
        return fail(error.what(), bad_input);
    } catch (const UsageError& error) {
        return fail(error.what(), wrong_usage);
    } catch (const engine::NotKept& loss) {
        complain(loss.what());
        return fail("interrupted", engine::interruption_status());
    } catch (const Cancelled&) {
        return fail("interrupted", engine::interruption_status());
    } catch (const std::exception& error) {
        return fail(reason_of(error), failed);
    }
}

}  // namespace ir::cli
