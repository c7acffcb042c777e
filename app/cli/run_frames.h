#pragma once

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/progress_line.h"
#include "app/engine/execution.h"
#include "renderers/core/error.h"

namespace ir::cli {

graph::FrameOptions frame_options(const MachineFlags& flags, const std::vector<std::string>& wanted = {},
                                  double initial_capacity = 1);

/// Runs `work`, which may throw Cancelled, under a line of progress that has begun, and clears it. Where it
/// was cancelled a line says that `unwritten` is not written; empty: nothing was to be.
template <class Work>
auto under_progress(ProgressLine& line, const std::string& unwritten, Work work) {
    try {
        auto result = work();
        line.clear();
        return result;
    } catch (const Cancelled&) {
        line.clear();
        if (!unwritten.empty()) std::cerr << "interreflect-cli: " << unwritten << " is not written\n";
        throw;
    }
}

/// Loader warnings and frame messages, one line each, to standard error.
void print_messages(const engine::Execution& execution, const FrameReport& report);
void print_messages(const std::vector<Message>& messages);
/// A note of explanations that the patterns match and that are no images, which no file can hold.
void note_lists(const std::vector<std::string>& patterns, const FrameReport& report);

/// A note where shaders were changed and passes ran on the host, which use none.
void note_host_bodies(const MachineFlags& flags, const engine::Experiment& experiment, FrameReport& report);

/// Before work whose result goes to `file`: throws UsageError, naming `option`, where its folder is missing.
void require_folder_of(const std::string& file, const std::string& option);

/// Throws Error, naming --out, where it is not there and cannot be made.
void make_out_folder(const std::filesystem::path& folder);

}  // namespace ir::cli
