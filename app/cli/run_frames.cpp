#include "app/cli/run_frames.h"

#include <algorithm>
#include <iostream>

#include "app/engine/interruption.h"
#include "app/engine/run_frames.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"

namespace ir::cli {

graph::FrameOptions frame_options(const MachineFlags& flags, const std::vector<std::string>& wanted,
                                  double initial_capacity) {
    graph::FrameOptions options;
    options.wanted = wanted;
    options.memory_budget = parse_bytes(flags.memory);
    options.initial_capacity = initial_capacity;
    options.cancel = &engine::interruption();
    return options;
}

void print_messages(const engine::Execution& execution, const FrameReport& report) {
    for (const auto& warning : execution.scene().warnings) std::cerr << "warning: " << warning.text << "\n";
    print_messages(report.messages);
}

void print_messages(const std::vector<Message>& messages) {
    for (const auto& message : messages)
        std::cerr << (message.severity == Severity::note ? "note: " : "warning: ") << message.text << "\n";
}

void note_lists(const std::vector<std::string>& patterns, const FrameReport& report) {
    std::string lists;
    for (const auto& resource : report.resources) {
        const bool requested = std::any_of(patterns.begin(), patterns.end(), [&](const auto& pattern) {
            return graph::matches(pattern, resource.key);
        });
        if (requested && resource.explains && !resource.fields.empty())
            lists += (lists.empty() ? "" : ", ") + resource.key;
    }
    if (!lists.empty())
        std::cerr << "note: --dump writes images; these explanations are lists, which the window shows as "
                     "tables and in space: "
                  << lists << "\n";
}

void note_host_bodies(const MachineFlags& flags, const engine::Experiment& experiment, FrameReport& report) {
    const auto on_host = engine::host_bodies(report);
    if (on_host.empty() || (flags.shaders.empty() && experiment.shaders.empty())) return;
    report.messages.push_back({Severity::note, "render",
                               "passes that run on the host use no shaders of " +
                                   std::string(experiment.shaders.empty() ? "--shaders" : "the experiment") +
                                   " (" + listed(on_host) + "); --processor gl puts all on the device"});
}

void require_folder_of(const std::string& file, const std::string& option) {
    const auto folder = std::filesystem::absolute(behind_links(file)).parent_path();
    if (!std::filesystem::is_directory(folder))
        throw UsageError(option + " '" + file + "': there is no folder " + folder.string());
}

void make_out_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error("--out " + folder.string() + ": cannot be created (" + error.message() + ")");
}

}  // namespace ir::cli
