#pragma once

#include <string>

#include "app/cli/command.h"
#include "renderers/core/shard.h"

namespace ir::cli {

/// "--shard I/N" and "--shard-from-env"
struct ShardFlags {
    std::string text;
    bool is_from_environment = false;
};

/// `what` is divided: "variation", "plot".
void add_shard_flags(CLI::App& command, ShardFlags& flags, const std::string& what);

/// All of the work where no flag is given; that of this task of a Slurm job array, whatever number its tasks
/// begin with. Throws UsageError.
Shard chosen_shard(const ShardFlags& flags);

/// Of a file that all tasks are told to write, the one that a shard writes: "table-2-of-4.csv". The file
/// itself where the work is not divided, and for standard output.
std::string file_of_shard(const std::string& file, const Shard& shard);

}  // namespace ir::cli
