#include "app/cli/shard.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "app/engine/division.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

/// All of the text is a whole number.
std::optional<int> whole_number(const std::string& text) {
    int number = 0;
    const auto* end = text.data() + text.size();
    const auto result = std::from_chars(text.data(), end, number);
    if (result.ec != std::errc{} || result.ptr != end) return {};
    return number;
}

Shard parse_shard(const std::string& text) {
    const auto slash = text.find('/');
    const auto index = whole_number(text.substr(0, slash));
    const auto count = slash == std::string::npos ? index : whole_number(text.substr(slash + 1));
    if (slash == std::string::npos || !index || !count || *index < 1 || *index > *count)
        throw UsageError("--shard '" + text +
                         "': give I/N with I from 1 to N, as in 1/4; the first shard is 1, not 0");
    return {*index, *count};
}

/// Of the environment; absent: `otherwise`.
int variable(const char* name, std::optional<int> otherwise = {}) {
    const char* text = std::getenv(name);
    const auto refused = [&](const std::string& why) {
        throw UsageError(std::string("--shard-from-env: ") + name + why);
    };
    if (!text && !otherwise) refused(" is not set; run it in a Slurm job array, or give --shard I/N");
    if (!text) return *otherwise;
    const auto number = whole_number(text);
    if (!number) refused(" is '" + std::string(text) + "', not a whole number");
    return *number;
}

/// A job array may begin with any number and leave some out: --array=0-3, 1-4, 10-40:10.
Shard shard_of_task() {
    const int id = variable("SLURM_ARRAY_TASK_ID"), count = variable("SLURM_ARRAY_TASK_COUNT");
    const int first = variable("SLURM_ARRAY_TASK_MIN", 0), step = variable("SLURM_ARRAY_TASK_STEP", 1);
    const std::int64_t distance = std::int64_t{id} - first;
    if (count < 1 || step < 1 || distance < 0 || distance % step != 0 || distance / step >= count)
        throw UsageError("--shard-from-env: task " + std::to_string(id) + " is none of " +
                         std::to_string(count) + " from " + std::to_string(first) + " in steps of " +
                         std::to_string(step) + "; submit with --array=FIRST-LAST without gaps");
    return {static_cast<int>(distance / step) + 1, count};
}

}  // namespace

void add_shard_flags(CLI::App& command, ShardFlags& flags, const std::string& what) {
    command.add_option("--shard", flags.text,
                       "I/N: only every N-th " + what + ", beginning with the I-th; I counts from 1 to N");
    command.add_flag("--shard-from-env", flags.is_from_environment,
                     "The shard of this task of a Slurm job array (SLURM_ARRAY_TASK_ID, _MIN, _STEP and "
                     "_COUNT), whatever number the array begins with");
}

Shard chosen_shard(const ShardFlags& flags) {
    if (flags.is_from_environment && !flags.text.empty())
        throw UsageError("give --shard or --shard-from-env, not both");
    if (flags.is_from_environment) return shard_of_task();
    return flags.text.empty() ? Shard{} : parse_shard(flags.text);
}

std::string file_of_shard(const std::string& file, const Shard& shard) {
    if (shard.count == 1 || file.empty() || file == "-") return file;
    const std::filesystem::path path(file);
    const auto name = engine::part_name(path.stem().string(), shard.index, shard.count);
    return (path.parent_path() / (name + path.extension().string())).string();
}

}  // namespace ir::cli
