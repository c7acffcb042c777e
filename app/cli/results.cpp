#include "app/cli/results.h"

#include "app/cli/load_project.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/command.h"
#include "app/engine/execution.h"
#include "projects/changes.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Id of the method that rendered it; empty where the index does not tell.
std::string method_of(const projects::KeptResult& result) {
    const auto found = result.inputs.find("method");
    return found != result.inputs.end() && found->is_string() ? found->get<std::string>() : "";
}

Json to_json(const projects::ResultVersion& version) {
    Json json{{"label", version.label}, {"key", version.key}};
    if (version.samples > 0) json["samples"] = version.samples;
    return json;
}

/// The experiment that a version is of, as it is now.
std::string now_of(const std::string& text, const projects::Project& project,
                   const projects::ResultIndex& index) {
    if (projects::find_item(project.experiments, text)) return "now:" + text;
    for (const auto& entry : index.entries())
        if (entry.key.compare(0, text.size(), text) == 0 &&
            projects::find_item(project.experiments, entry.experiment))
            return "now:" + entry.experiment;
    throw UsageError("the project has no experiment of '" + projects::printable(text, 60) +
                     "' any more; give a second result to compare with");
}

}  // namespace

int list_results(const projects::LoadedProject& loaded, bool json) {
    const auto now = as_on_disk(loaded);
    const auto index = projects::ResultIndex::load(loaded.folder);
    std::set<std::string> current;
    for (const auto& experiment : now.experiments)
        current.insert(projects::result_key(now, experiment, engine::registry()));
    Json rows = Json::array();
    for (const auto& entry : index.entries()) {
        const auto& from = entry.provenance;
        rows.push_back({{"key", entry.key},
                        {"experiment", entry.experiment},
                        {"method", method_of(entry)},
                        {"date", from.date},
                        {"samples", entry.samples},
                        {"build", from.build},
                        {"device", from.driver},
                        {"backend", from.backend},
                        {"processor", from.processor},
                        {"state", current.count(entry.key) ? "current" : "stale"},
                        {"can_continue", projects::file_of(entry, projects::state_role) != nullptr}});
    }
    if (json) {
        std::cout << Json{{"results", rows}}.dump(2) << "\n";
        return done;
    }
    if (rows.empty()) std::cout << "no kept results\n";
    for (const auto& entry : index.entries()) {
        const auto& from = entry.provenance;
        std::cout << projects::printable(entry.key.substr(0, 12)) << "  "
                  << projects::printable(entry.experiment) << "  " << projects::printable(method_of(entry))
                  << "  " << projects::printable(from.date) << "  ";
        if (entry.samples > 0) std::cout << entry.samples << " samples  ";
        std::cout << projects::printable(from.build) << "  " << projects::printable(from.driver) << "  "
                  << (current.count(entry.key) ? "current" : "stale") << "\n";
    }
    return done;
}

int print_changes(const projects::LoadedProject& loaded, const std::vector<std::string>& versions,
                  bool json) {
    const auto now = as_on_disk(loaded);
    const auto index = projects::ResultIndex::load(loaded.folder);
    const auto find = [&](const std::string& text) {
        return projects::find_version(text, now, index, engine::registry());
    };
    const auto before = find(versions.at(0));
    const auto after = find(versions.size() > 1 ? versions[1] : now_of(versions[0], now, index));
    const auto found = projects::changes(before, after);
    if (json) {
        std::cout << Json{{"before", to_json(before)},
                          {"after", to_json(after)},
                          {"inputs", found.inputs},
                          {"provenance", found.provenance}}
                         .dump(2)
                  << "\n";
        return done;
    }
    std::cout << before.label << " → " << after.label << "\n";
    if (found.inputs.empty()) std::cout << "  nothing that the picture depends on changed\n";
    for (const auto& line : found.inputs) std::cout << "  " << line << "\n";
    for (const auto& line : found.provenance) std::cout << "  " << line << "\n";
    return done;
}

}  // namespace ir::cli
