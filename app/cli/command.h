#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

namespace ir::cli {

/// The contract with scripts; engine::interruption_status() where a signal ended the work.
enum ExitStatus { done = 0, failed = 1, wrong_usage = 2, bad_input = 3, limit_exceeded = 4 };

/// Each adds its subcommand; the chosen one's callback stores what main runs after parsing.
using Run = std::function<int()>;
void add_info(CLI::App& app, Run& run);
void add_list(CLI::App& app, Run& run);
void add_describe(CLI::App& app, Run& run);
void add_scene(CLI::App& app, Run& run);
void add_render(CLI::App& app, Run& run);
void add_compare(CLI::App& app, Run& run);
void add_project(CLI::App& app, Run& run);
void add_reference(CLI::App& app, Run& run);
void add_plot(CLI::App& app, Run& run);
void add_sweep(CLI::App& app, Run& run);
void add_bench(CLI::App& app, Run& run);

/// Options that choose the machine, shared by commands that render.
struct MachineFlags {
    std::string backend, device, memory, processor;
    int threads = 0;
    bool debug = false;
};
void add_machine_flags(CLI::App& command, MachineFlags& flags);
/// As CLI::Range, which lets NaN pass.
inline CLI::Validator within(double min, double max) {
    const CLI::Range range(min, max);
    return {[range](std::string& text) {
                if (std::isnan(std::strtod(text.c_str(), nullptr))) return text + " is not a number";
                return range(text);
            },
            range.get_description()};
}

/// "2GB", "500MB", "1.5 GiB" or bytes; 0 when empty. Throws UsageError.
std::uint64_t parse_bytes(const std::string& text);

}  // namespace ir::cli
