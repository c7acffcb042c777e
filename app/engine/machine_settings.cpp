#include "app/engine/machine_settings.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

#include "renderers/core/changed_shaders.h"
#include "renderers/core/error.h"
#include "renderers/core/named_files.h"
#include "renderers/core/resources_path.h"

namespace ir::engine {
namespace {

constexpr double gigabyte = 1e9;

const std::string& doc_of(const char* key) {
    static const auto all = machine_settings().descriptions();
    return find(all, key)->doc;
}

std::filesystem::path shader_folder(const std::string& name) {
    if (name.empty()) return {};
    std::error_code ignored;
    for (const auto* part : shader_folders)
        if (!std::filesystem::is_directory(std::filesystem::path(name) / part, ignored))
            throw UsageError("--shaders '" + name + "' has no folder " + part +
                             "/; give a copy of all shaders, as in " + shader_directory().string());
    return std::filesystem::absolute(name);
}

}  // namespace

std::optional<Processor> MachineSettings::chosen_processor() const {
    if (processor == Body::automatic) return {};
    return processor == Body::gl ? Processor::gl : Processor::host;
}

std::uint64_t MachineSettings::memory_budget() const {
    return static_cast<std::uint64_t>(memory * gigabyte);
}

double gigabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / gigabyte;
}

const ParameterTable<MachineSettings>& machine_settings() {
    static const auto table = [] {
        ParameterTable<MachineSettings> t;
        t.add(&MachineSettings::processor,
              {.key = "processor",
               .label = "Processor",
               .doc = "What runs passes that have two bodies.",
               .choices = {{"auto", "Automatic", "The host where the device is software, else the device."},
                           {"gl", "OpenGL device", "The device that the status bar names."},
                           {"host", "Host", "The threads and vector units of the host."}}});
        t.add(&MachineSettings::threads, {.key = "threads",
                                          .label = "Threads",
                                          .doc = "Threads of passes on the host; 0: all.",
                                          .hard = {0, 1024},
                                          .effect = Effect::cost});
        return t.add(&MachineSettings::memory,
                     {.key = "memory",
                      .label = "Memory budget",
                      .doc = "Of the buffers of one experiment; 0: none. What does not fit is rendered in "
                             "batches, or refused.",
                      .unit = "GB",
                      .hard = {0, 1e6},
                      .effect = Effect::cost});
    }();
    return table;
}

void add_machine_flags(CLI::App& command, MachineFlags& flags) {
    command.add_option("--backend", flags.backend,
                       "OpenGL through egl or osmesa (default: the best that works)");
    command.add_option("--device", flags.device, "Part of the name of the device to use");
    command.add_option("--memory", flags.memory, doc_of("memory") + " Such as 2GB");
    command.add_option("--threads", flags.threads, doc_of("threads"))->check(CLI::Range(0, 1024));
    command.add_option("--processor", flags.processor,
                       doc_of("processor") +
                           " auto, gl or host (default: auto, the host where the device is "
                           "software)");
    command
        .add_option("--shaders", flags.shaders,
                    "Folder of shaders in place of the program's own, such as a copy to work on")
        ->each([](const std::string& name) { use_shaders_of(std::filesystem::absolute(name)); });
    command.add_flag("--gl-debug", flags.debug, "Report the driver's debug messages");
    add_outside_flag(command);
}

void add_outside_flag(CLI::App& command) {
    command.add_flag_function(
        "--allow-outside", [](std::int64_t) { allow_outside_files(); },
        "Let scenes and packed projects name files outside of their folders");
    command.add_flag_function(
        "--allow-shaders", [](std::int64_t) { allow_changed_shaders(); },
        "Let packed projects and pictures of others change shaders");
}

MachineOptions machine_options(const MachineFlags& flags) {
    const auto shaders = shader_folder(flags.shaders);
    look_at_shaders_again();  // results name those of now, whatever is edited meanwhile
    return {
        flags.backend, flags.device, flags.debug, flags.threads.value_or(0), parse_processor(flags.processor),
        shaders};
}

std::uint64_t parse_bytes(const std::string& text) {
    if (text.empty()) return 0;
    double number = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string unit(result.ptr, text.data() + text.size());
    std::erase(unit, ' ');
    double scale = 0;
    if (unit.empty() || unit == "B") scale = 1;
    if (unit == "kB" || unit == "KB") scale = 1e3;
    if (unit == "MB" || unit == "M") scale = 1e6;
    if (unit == "GB" || unit == "G") scale = 1e9;
    if (unit == "MiB") scale = 1048576.0;
    if (unit == "GiB") scale = 1073741824.0;
    if (result.ec != std::errc{} || scale == 0 || !(number >= 0) || !std::isfinite(number) ||
        number * scale > 9e18)
        throw UsageError("--memory '" + text +
                         "' is not a size; give a number and B, kB, MB, GB, MiB or GiB");
    return static_cast<std::uint64_t>(number * scale);
}

}  // namespace ir::engine
