#include <charconv>
#include <cmath>

#include "app/cli/command.h"
#include "renderers/core/error.h"

namespace ir::cli {

void add_machine_flags(CLI::App& command, MachineFlags& flags) {
    command.add_option("--backend", flags.backend,
                       "OpenGL through egl or osmesa (default: the best that works)");
    command.add_option("--device", flags.device, "Part of the name of the device to use");
    command.add_option("--memory", flags.memory, "Budget for buffers, such as 2GB (default: none)");
    command.add_option("--threads", flags.threads, "Threads of passes on the CPU (default: all)")
        ->check(CLI::Range(0, 1024));
    command.add_option("--processor", flags.processor,
                       "What runs passes with two bodies: auto, gl or host (default: auto, the host where "
                       "the device is software)");
    command.add_flag("--gl-debug", flags.debug, "Report the driver's debug messages");
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
    if (result.ec != std::errc{} || scale == 0 || !(number > 0) || !std::isfinite(number) ||
        number * scale > 9e18)
        throw UsageError("--memory '" + text +
                         "' is not a size; give a number and B, kB, MB, GB, MiB or GiB");
    return static_cast<std::uint64_t>(number * scale);
}

}  // namespace ir::cli
