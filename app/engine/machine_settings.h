#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/engine/execution.h"
#include "renderers/core/parameter.h"

namespace CLI {
class App;
}

namespace ir::engine {

/// What a person chooses for a machine, whatever the project.
struct MachineSettings {
    enum class Body { automatic, gl, host };
    Body processor = Body::automatic;
    int threads = 0;
    double memory = 0;  ///< GB

    std::optional<Processor> chosen_processor() const;
    std::uint64_t memory_budget() const;  ///< bytes; 0: none
};
const ParameterTable<MachineSettings>& machine_settings();

/// The options that choose and set a machine, shared by the window and by commands that render.
struct MachineFlags {
    std::string backend = {}, device = {}, memory = {}, processor = {}, shaders = {};
    std::optional<int> threads = {};
    bool debug = false;
};
void add_machine_flags(CLI::App& command, MachineFlags& flags);
/// The options by which a person lets documents of others name any file and change shaders;
/// add_machine_flags() adds them, too.
void add_outside_flag(CLI::App& command);
/// Throws UsageError.
MachineOptions machine_options(const MachineFlags& flags);

double gigabytes(std::uint64_t bytes);
/// "2GB", "500MB", "1.5 GiB" or bytes; 0 when empty. Throws UsageError.
std::uint64_t parse_bytes(const std::string& text);

}  // namespace ir::engine
