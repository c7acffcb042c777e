// `interreflect-cli submit`: a Slurm job array that does a command in shards.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <regex>
#include <sstream>

#include "app/cli/command.h"
#include "app/cli/command_line.h"
#include "app/engine/version.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"

namespace ir::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct SubmitFlags {
    int tasks = 0, cpus = 4;
    std::string mem = "4G", time = "04:00:00", name, log, script;
    Words options;  ///< of sbatch
    bool run = false;
    Words command;
};

/// Commands that take --shard-from-env.
const Words divided{"sweep", "reference", "render", "plot"};

/// Those that go on where they were stopped. Others would begin anew, and never end.
bool goes_on(const std::string& command) {
    return command == "sweep" || command == "reference";
}

bool has_option(const Words& words, const std::string& option) {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return word == option || word.rfind(option + "=", 0) == 0;
    });
}

/// Throws UsageError.
void check_divided(const Words& words) {
    if (words.empty()) throw UsageError("say what the tasks do: " + listed(divided));
    if (std::find(divided.begin(), divided.end(), words.front()) == divided.end())
        throw UsageError("'" + words.front() + "' cannot be divided" + known_are(words.front(), divided));
    if (words.size() > 1 && words.front() == "sweep" && words[1] == "plan")
        throw UsageError("'sweep plan' is not divided; run it before the tasks");
    if (words.size() > 1 && words[1] == "merge")
        throw UsageError("'" + words.front() + " merge' is not divided; run it when all tasks are done");
}

/// The command as each task runs it. Throws UsageError, and CLI::ParseError as the command itself.
Words task_command(const Words& words) {
    for (const char* option : {"--shard", "--shard-from-env"})
        if (has_option(words, option))
            throw UsageError(std::string(option) + " is what submit adds; leave it out");
    auto command = words;
    command.push_back("--shard-from-env");
    if (words.front() == "sweep" && !has_option(words, "--resume")) command.push_back("--resume");
    check_command(command);
    return command;
}

/// One line of a script that `sbatch` reads.
void check(const std::string& option, const std::string& value, const char* pattern, const char* mend) {
    if (!std::regex_match(value, std::regex(pattern))) throw UsageError(option + " '" + value + "': " + mend);
}

constexpr int min_minutes = 5;  // the script is warned two minutes before the end

/// MINUTES, MINUTES:SECONDS, HOURS:MINUTES:SECONDS, DAYS-HOURS, DAYS-HOURS:MINUTES[:SECONDS].
double minutes_of(const std::string& time) {
    const auto dash = time.find('-');
    const bool has_days = dash != std::string::npos;
    std::vector<double> parts;
    std::stringstream rest(has_days ? time.substr(dash + 1) : time);
    for (std::string part; std::getline(rest, part, ':');) parts.push_back(std::stod(part));
    const bool begins_with_hours = has_days || parts.size() == 3;
    double minutes = has_days ? std::stod(time.substr(0, dash)) * 24 * 60 : 0;
    double unit = begins_with_hours ? 60 : 1;
    for (const double part : parts) {
        minutes += part * unit;
        unit /= 60;
    }
    return minutes;
}

void check(const SubmitFlags& flags) {
    if (flags.tasks == 0)
        throw UsageError(has_option(flags.command, "--tasks")
                             ? "give --tasks before the command that is divided"
                             : "--tasks is required: how many share the work");
    check("--mem", flags.mem, "[0-9]+[KMGT]?", "give megabytes, or as in 4G");
    check("--time", flags.time, "([0-9]+-)?[0-9]+(:[0-9]+){0,2}",
          "give HOURS:MINUTES:SECONDS, as in 04:00:00");
    if (minutes_of(flags.time) < min_minutes)
        throw UsageError("--time '" + flags.time + "': give at least " + std::to_string(min_minutes) +
                         " minutes; the last two are for keeping what is there");
    check("--name", flags.name, "[A-Za-z0-9_.-]*", "use letters, digits and _.- alone");
    check("--log", flags.log, "[^\n\"\\\\]*", "must be one line without quotes");
    for (const auto& option : flags.options)
        check("--sbatch", option, "-[^\n]*", "give an option of sbatch, as in --sbatch=--partition=short");
}

std::string quoted(const Words& words) {
    std::string line;
    for (const auto& word : words) line += (line.empty() ? "" : " ") + engine::shell_word(word);
    return line;
}

/// What the person still has to do when all tasks are done.
std::string afterwards(const Words& words) {
    if (words.front() != "sweep") return {};
    std::string out = "FOLDER";
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--out" && i + 1 < words.size()) out = words[i + 1];
        if (words[i].rfind("--out=", 0) == 0) out = words[i].substr(6);
    }
    if (out.find('\n') != std::string::npos) return {};  // no line of comment
    return "# When all tasks are done: interreflect-cli sweep merge " + engine::shell_word(out) + " --out " +
           engine::shell_word((fs::path(out) / "sweep.json").string()) + "\n";
}

std::string script_of(const SubmitFlags& flags, const Words& words) {
    const auto name = flags.name.empty() ? "interreflect-" + words.front() : flags.name;
    const auto log = flags.log.empty() ? std::string("%x-%A_%a.log") : flags.log;
    std::string text = "#!/bin/sh\n# By interreflect-cli " + engine::version() + ": " +
                       std::to_string(flags.tasks) + (flags.tasks == 1 ? " task" : " tasks") +
                       " of one command. It may be submitted again until all is done.\n" +
                       afterwards(flags.command);
    const auto option = [&](const std::string& line) { text += "#SBATCH " + line + "\n"; };
    option("--job-name=" + name);
    option("--array=1-" + std::to_string(flags.tasks));
    option("--cpus-per-task=" + std::to_string(flags.cpus));
    option("--mem=" + flags.mem);
    option("--time=" + flags.time);
    option("--requeue");
    option("--open-mode=append");
    option("--output=\"" + log + "\"");
    option("--signal=B:USR1@120");
    for (const auto& each : flags.options) option(each);
    text += "cd " + engine::shell_word(fs::current_path().string()) + " || exit 1\n";
    text +=
        R"(# Two minutes before the time is up the program is told to end. What else ends it (scancel, another job that
# goes first) is passed on; a node that fails queues its tasks again by itself.
program=
is_late=
is_told=
end() {
  is_told=1
  [ -z "$program" ] || kill -TERM "$program" 2>/dev/null
}
trap 'is_late=1; end' USR1
trap end TERM
)";
    auto command = Words{fs::read_symlink("/proc/self/exe").string()};
    command.insert(command.end(), words.begin(), words.end());
    text += quoted(command);
    if (!has_option(words, "--threads")) text += " --threads \"${SLURM_CPUS_PER_TASK:-0}\"";
    text += R"( &
program=$!
[ -z "$is_told" ] || end
wait "$program"
status=$?
# A signal ends the waiting, not the program. What was waited for already is 127 in some shells.
while [ "$is_told" ]; do
  is_told=
  wait "$program"
  ended=$?
  [ "$ended" -eq 127 ] || status=$ended
done
)";
    if (goes_on(words.front()))
        text +=
            R"(if [ "$is_late" ] && [ "$status" -eq 143 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 1000 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
fi
)";
    else
        text += "if [ \"$is_late\" ] && [ \"$status\" -eq 143 ]; then\n  echo '" + words.front() +
                ": the time was up before the shard was done; submit it with more --time' >&2\nfi\n";
    text += "exit \"$status\"\n";
    return text;
}

/// Its number goes to standard output.
void submit(const std::string& script) {
    std::cout.flush();
    auto* sbatch = ::popen("sbatch", "w");
    if (!sbatch) throw Error("sbatch cannot be started");
    const bool is_written = std::fwrite(script.data(), 1, script.size(), sbatch) == script.size();
    const int status = ::pclose(sbatch);
    if (!is_written || status != 0)
        throw Error("sbatch did not take the job; without --run the script is only printed");
}

int print_script(const SubmitFlags& flags) {
    check_divided(flags.command);
    check(flags);
    const auto script = script_of(flags, task_command(flags.command));
    if (!flags.script.empty()) write_file(flags.script, script);
    (flags.run ? std::cerr : std::cout) << script;
    if (flags.run) submit(script);
    return done;
}

}  // namespace

void add_submit(CLI::App& app, Run& run) {
    auto flags = std::make_shared<SubmitFlags>();
    auto* command = app.add_subcommand(
        "submit",
        "Print a Slurm job array that does a command in shards: submit --tasks 16 sweep P NAME --out FOLDER");
    command->add_option("--tasks", flags->tasks, "Tasks of the job array, one shard each")
        ->check(CLI::Range(1, 100000));
    command->add_option("--cpus", flags->cpus, "Processors of a task")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->add_option("--mem", flags->mem, "Memory of a task, as sbatch takes it")->capture_default_str();
    command
        ->add_option(
            "--time", flags->time,
            "Longest time of a task; two minutes before it is up, sweep and reference keep their work and queue "
            "again, others end")
        ->capture_default_str();
    command->add_option("--name", flags->name, "Name of the job (default: interreflect-COMMAND)");
    command->add_option("--log", flags->log, "File for what tasks print (default: NAME-JOB_TASK.log)");
    command
        ->add_option("--sbatch", flags->options,
                     "One more option of sbatch, as in --sbatch=--partition=short; repeat for more")
        ->allow_extra_args(false);  // what follows is the command
    command->add_option("--script", flags->script, "File for the script, too");
    command->add_flag("--run", flags->run, "Give the script to sbatch");
    command->prefix_command();
    command->callback([flags, command, &run] {
        flags->command = command->remaining();
        run = [flags] { return print_script(*flags); };
    });
}

}  // namespace ir::cli
