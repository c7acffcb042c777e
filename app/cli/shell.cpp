// What a shell and `man` are told of the commands, from the commands themselves.
#include <array>
#include <iostream>

#include "app/cli/command.h"
#include "app/engine/execution.h"
#include "app/engine/version.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/scene/scene.h"

namespace ir::cli {
namespace {

constexpr const char* program = "interreflect-cli";

struct Option {
    std::string name;  ///< "--out", or "PROJECT" for one without a name
    std::string doc;
    bool is_positional = false, takes_value = false;
};

struct Command {
    std::string name, doc;
    std::vector<Option> options;
    std::vector<Command> below;  ///< "merge" of "sweep"
};

Command command_of(const CLI::App& app) {
    const auto all = [](const auto*) { return true; };
    Command command{app.get_name(), app.get_description(), {}, {}};
    for (const auto* option : app.get_options(all)) {
        const bool is_positional = option->get_lnames().empty();
        command.options.push_back(
            {is_positional ? option->get_name(true) : "--" + option->get_lnames().front(),
             option->get_description(), is_positional, option->get_items_expected_max() > 0});
    }
    for (const auto* each : app.get_subcommands(all)) {
        auto inner = command_of(*each);
        if (each->get_name().empty())  // an option group
            std::move(inner.options.begin(), inner.options.end(), std::back_inserter(command.options));
        else
            command.below.push_back(std::move(inner));
    }
    return command;
}

std::vector<Command> commands_of(const CLI::App& app) {
    return command_of(app).below;
}

/// Words that the value of an option may be; empty: a file.
std::vector<std::string> values_of(const std::string& option) {
    if (option == "--method") return words_of(engine::registry().methods(), &MethodDescription::id);
    if (option == "--processor")
        return words_of(find(engine::machine_settings().descriptions(), "processor")->choices, &Choice::key);
    if (option == "--backend")
        return words_of(std::array{gl::Backend::egl, gl::Backend::osmesa},
                        [](gl::Backend backend) { return gl::to_string(backend); });
    if (option == "--scene") {
        auto names = scene::builtin_names();
        for (auto& name : names) name = "builtin:" + name;
        return names;
    }
    return {};
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::vector<std::string> names_of(const Command& command) {
    std::vector<std::string> names;
    for (const auto& option : command.options)
        if (!option.is_positional) names.push_back(option.name);
    return names;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// Between single quotes of a shell.
std::string in_quotes(const std::string& text) {
    return "'" + replaced(text, "'", "'\\''") + "'";
}

void print_bash(const std::vector<Command>& commands) {
    std::cout << "# bash completion for " << program << " " << engine::version() << "\n"
              << "_interreflect_cli() {\n"
              << "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
              << "  COMP_WORDBREAKS=${COMP_WORDBREAKS//:}\n"
              << "  case $before in\n";
    for (const char* option : {"--method", "--processor", "--backend", "--scene"})
        std::cout << "    " << option << ") COMPREPLY=($(compgen -W " << in_quotes(joined(values_of(option)))
                  << " -- \"$word\")); [[ ${#COMPREPLY[@]} -gt 0 ]] && return ;;\n";
    std::cout << "  esac\n"
              << "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
              << "    COMPREPLY=($(compgen -W " << in_quotes(joined(words_of(commands, &Command::name)))
              << " -- \"$word\")); return\n"
              << "  fi\n"
              << "  [[ $word != -* ]] && { COMPREPLY=($(compgen -f -- \"$word\")); return; }\n"
              << "  case ${COMP_WORDS[1]} in\n";
    for (const auto& command : commands)
        std::cout << "    " << command.name << ") COMPREPLY=($(compgen -W "
                  << in_quotes(joined(names_of(command))) << " -- \"$word\")) ;;\n";
    std::cout << "  esac\n}\ncomplete -o filenames -F _interreflect_cli " << program << "\n";
}

void print_zsh(const std::vector<Command>& commands) {
    const auto escaped = [](std::string text) {
        for (const char* special : {"\\", "[", "]", ":"})
            text = replaced(text, special, std::string("\\") + special);
        return text;
    };
    std::cout << "#compdef " << program << "\n# zsh completion for " << program << " " << engine::version()
              << "\n_interreflect_cli() {\n  local -a commands=(\n";
    for (const auto& command : commands)
        std::cout << "    " << in_quotes(command.name + ":" + escaped(command.doc)) << "\n";
    std::cout << "  )\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
              << "  shift words; (( CURRENT-- ))\n  case $words[1] in\n";
    for (const auto& command : commands) {
        std::cout << "    " << command.name << ") _arguments";
        for (const auto& option : command.options) {
            if (option.is_positional) continue;
            auto spec = "*" + option.name + "[" + escaped(option.doc) + "]";
            const auto values = values_of(option.name);
            if (option.takes_value && values.empty()) spec += ":value:_files";
            if (option.takes_value && !values.empty()) {
                std::vector<std::string> words;
                for (const auto& value : values) words.push_back(escaped(value));
                spec += ":value:(" + joined(words) + ")";
            }
            std::cout << " \\\n      " << in_quotes(spec);
        }
        std::cout << " \\\n      '*:file:_files' ;;\n";
    }
    // Where it is installed, the file is the function that the first Tab calls.
    std::cout << "  esac\n}\nif [[ ${funcstack[1]} == _" << program
              << " ]]; then\n  _interreflect_cli \"$@\"\n"
              << "else\n  compdef _interreflect_cli " << program << "\nfi\n";
}

void print_fish(const std::vector<Command>& commands) {
    std::cout << "# fish completion for " << program << " " << engine::version() << "\n";
    for (const auto& command : commands) {
        std::cout << "complete -c " << program << " -n __fish_use_subcommand -f -a " << command.name << " -d "
                  << in_quotes(command.doc) << "\n";
        for (const auto& option : command.options) {
            if (option.is_positional) continue;
            std::cout << "complete -c " << program << " -n '__fish_seen_subcommand_from " << command.name
                      << "' -l " << option.name.substr(2) << (option.takes_value ? " -r" : "");
            if (const auto values = values_of(option.name); !values.empty())
                std::cout << " -a " << in_quotes(joined(values));
            std::cout << " -d " << in_quotes(replaced(option.doc, "\\", "\\\\")) << "\n";
        }
    }
}

/// Text of a manual page: no line of it is a request.
std::string roff(std::string text) {
    text = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
    if (!text.empty() && (text.front() == '.' || text.front() == '\'')) text = "\\&" + text;
    return text;
}

void print_section(const Command& command, const std::string& above) {
    const auto name = above + command.name;
    std::cout << ".SS " << roff(name) << "\n" << roff(command.doc) << ".\n";
    for (const auto& option : command.options)
        std::cout << ".TP\n"
                  << (option.is_positional ? ".I " : ".B ") << roff(option.name) << "\n"
                  << roff(option.doc) << "\n";
    for (const auto& each : command.below) print_section(each, name + " ");
}

void print_manual(const CLI::App& app, const std::vector<Command>& commands) {
    std::cout << ".TH INTERREFLECT\\-CLI 1 \"\" \"Interreflect " << engine::version() << "\"\n"
              << ".SH NAME\n"
              << roff(program) << " \\- renders, compares and checks experiments on global illumination\n"
              << ".SH SYNOPSIS\n.B " << roff(program) << "\n.I COMMAND\n[\\fIOPTIONS\\fR]\n"
              << ".SH DESCRIPTION\n"
              << roff(app.get_description()) << "\n.SH COMMANDS\n";
    for (const auto& command : commands) print_section(command, "");
    std::cout << ".SH EXIT STATUS\n";
    for (const auto& status : exit_statuses())
        std::cout << ".TP\n.B " << status.value << "\n" << roff(status.doc) << "\n";
}

}  // namespace

const std::vector<ExitStatusText>& exit_statuses() {
    static const std::vector<ExitStatusText> all = {
        {"0", "done"},
        {"1", "failed while working"},
        {"2", "wrong usage"},
        {"3", "bad input file"},
        {"4", "a `--fail-above` was exceeded, or `--exact` not met"},
        {"129, 130, 143", "ended by SIGHUP, SIGINT, SIGTERM"},
    };
    return all;
}

void add_shell(CLI::App& app, Run& run) {
    auto shell = std::make_shared<std::string>();
    auto* completion = app.add_subcommand("completion", "What a shell needs to complete these commands");
    completion->add_option("SHELL", *shell, "bash, zsh or fish")->required();
    completion->callback([shell, &app, &run] {
        run = [shell, &app] {
            const auto commands = commands_of(app);
            if (*shell == "bash")
                print_bash(commands);
            else if (*shell == "zsh")
                print_zsh(commands);
            else if (*shell == "fish")
                print_fish(commands);
            else
                throw UsageError("unknown shell '" + *shell + "'" +
                                 known_are(*shell, {"bash", "zsh", "fish"}));
            return static_cast<int>(done);
        };
    });
    auto* manual = app.add_subcommand("manual", "All of this as a page for man");
    manual->callback([&app, &run] {
        run = [&app] {
            print_manual(app, commands_of(app));
            return static_cast<int>(done);
        };
    });
}

}  // namespace ir::cli
