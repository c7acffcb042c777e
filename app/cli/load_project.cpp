#include "app/cli/load_project.h"

#include <iostream>

#include "app/engine/execution.h"
#include "projects/keep.h"
#include "renderers/core/error.h"

namespace ir::cli {

projects::LoadedProject load_project(const std::string& project) {
    auto loaded = projects::load_project(project, engine::registry());
    for (const auto& messages :
         {loaded.messages, projects::unknown_key_messages(loaded.project, engine::registry())})
        for (const auto& message : messages) std::cerr << "note: " << message.text << "\n";
    return loaded;
}

void require_results(const std::string& project, const std::filesystem::path& folder) {
    try {
        if (!projects::ResultsGuard(folder).is_guarding())
            std::cerr << "note: " << project
                      << ": this file system locks no files; keep results from one process at a time\n";
    } catch (const Error& error) {
        throw Error(project + ": cannot keep results: " + error.what());
    }
}

projects::Project as_on_disk(const projects::LoadedProject& loaded) {
    for (const auto& experiment : loaded.project.experiments)
        if (!experiment.last_kept_key.empty())
            return projects::with_contents(loaded.project,
                                           projects::read_contents(loaded.project, loaded.folder));
    return loaded.project;
}

}  // namespace ir::cli
