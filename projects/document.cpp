#include "projects/document.h"

#include <algorithm>
#include <cctype>

#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::projects {

const Experiment& experiment_of(const Project& project, const std::string& id) {
    if (const auto* found = find_item(project.experiments, id)) return *found;
    throw UsageError("there is no experiment '" + printable(id, 60) + "' in the project" +
                     known_are(id, words_of(project.experiments, &Experiment::id)));
}

Experiment effective(const Experiment& experiment) {
    Experiment result = experiment;
    result.presets.clear();
    result.active_preset.clear();
    const auto found = experiment.presets.find(experiment.active_preset);
    if (found == experiment.presets.end()) return result;
    const Preset& preset = found->second;
    if (preset.size) result.size = *preset.size;
    if (preset.frames) result.frames = *preset.frames;
    for (const auto& [key, value] : preset.values) result.values[key] = value;
    return result;
}

bool is_valid_id(const std::string& id) {
    const auto allowed = [](unsigned char c) {
        return c < 0x80 && (std::isalnum(c) || c == '-' || c == '_' || c == '.');
    };
    return !id.empty() && id.size() <= 100 && id.front() != '.' && std::all_of(id.begin(), id.end(), allowed);
}

std::string free_id(const std::string& name, const std::vector<std::string>& taken) {
    std::string base;
    for (const char c : name.substr(0, 60)) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && std::isalnum(byte))
            base += static_cast<char>(std::tolower(byte));
        else if (!base.empty() && base.back() != '-')
            base += '-';
    }
    while (!base.empty() && base.back() == '-') base.pop_back();
    // "scene" stands for the scene's own lights and is never given away.
    if (base.empty() || base == scene_lights) base = base.empty() ? "item" : base + "-1";
    const auto is_taken = [&](const std::string& id) {
        return std::find(taken.begin(), taken.end(), id) != taken.end();
    };
    std::string id = base;
    for (int i = 2; is_taken(id); ++i) id = base + "-" + std::to_string(i);
    return id;
}

std::string free_experiment_id(const Project& project, const std::string& name) {
    std::vector<std::string> taken(project.kept_ids.begin(), project.kept_ids.end());
    for (const auto& experiment : project.experiments) taken.push_back(experiment.id);
    return free_id(name, taken);
}

Settings runnable_settings(const Experiment& experiment, const MethodDescription& method) {
    Settings known;
    for (const auto& [key, value] : effective(experiment).values)
        if (find(method.parameters, key)) known[key] = value;
    return completed(method.parameters, known);
}

}  // namespace ir::projects
