#include <algorithm>

#include "projects/edit_kinds.h"
#include "projects/edits.h"
#include "projects/match.h"
#include "projects/names.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "renderers/core/transport.h"

namespace ir::projects::edits {
namespace {

EditPtr changed(const Project& project, const Experiment& after, const std::string& label,
                const std::string& what) {
    validate(after);
    return replace(project, after, label, what.empty() ? "" : what + ":" + after.id);
}

/// After `change`, which has the copy to change.
template <class Change>
EditPtr changed(const Project& project, const std::string& id, const std::string& label,
                const std::string& what, Change change) {
    Experiment after = experiment_of(project, id);
    change(after);
    return changed(project, after, label, what);
}

Preset* active_preset(Experiment& experiment) {
    const auto found = experiment.presets.find(experiment.active_preset);
    return found == experiment.presets.end() ? nullptr : &found->second;
}

/// Where the value that the user sees is kept.
void put_value(Experiment& experiment, const std::string& key, const Value& value) {
    auto* preset = active_preset(experiment);
    Settings& home = preset && preset->values.count(key) != 0 ? preset->values : experiment.values;
    home[key] = value;
    experiment.extra_values.erase(key);
}

std::string label_of(const MethodDescription& method, const Settings& values) {
    if (values.size() != 1) return "Change " + std::to_string(values.size()) + " values";
    return "Change " + parameter_named(method.parameters, values.begin()->first).label;
}

/// Of the experiment's method; none where this build lacks it.
std::vector<ParameterDescription> parameters_of(const Registry& registry, const Experiment& experiment) {
    const auto* method = registry.find(experiment.method);
    return method ? method->parameters : std::vector<ParameterDescription>();
}

/// Whether the experiment, as `after` would have it, has its ground truth as its reference, where no scene's
/// file animates anything: to a name the moment does not matter.
bool is_judged_rightly(const Project& project, const Experiment& after, const Registry& registry) {
    auto ahead = project;
    *find_item(ahead.experiments, after.id) = after;
    const auto wrong = mismatched_references(ahead, registry, {[](const std::string&) { return false; }});
    return std::none_of(wrong.begin(), wrong.end(), [&](const auto& each) { return each.first == after.id; });
}

template <class Item>
void require_item(const Project& project, const std::string& id, const std::string& none) {
    if (id != none) item_of<Item>(project, id);
}

}  // namespace

EditPtr set_values(const Project& project, const Registry& registry, const std::string& experiment,
                   const Settings& values) {
    Experiment after = experiment_of(project, experiment);
    const auto& method = registry.at(after.method);
    std::string keys;
    for (const auto& [key, value] : values) {
        put_value(after, key, parameter_named(method.parameters, key).checked(value));
        keys += "," + key;
    }
    return changed(project, after, label_of(method, values), "values" + keys);
}

EditPtr reset_value(const Project& project, const Registry& registry, const std::string& experiment,
                    const std::string& key) {
    Experiment after = experiment_of(project, experiment);
    const auto& parameter = parameter_named(registry.at(after.method).parameters, key);
    put_value(after, key, parameter.default_value);
    return changed(project, after, "Reset " + parameter.label, "");
}

EditPtr set_method(const Project& project, const Registry& registry, const std::string& experiment,
                   const std::string& method) {
    Experiment after = experiment_of(project, experiment);
    const auto& description = registry.at(method);
    if (after.method == method) return changed(project, after, "Change method", "");
    const auto carried = [&](const Settings& values) {
        return carry_transport(values, parameters_of(registry, experiment_of(project, experiment)),
                               description.parameters)
            .values;
    };
    if (is_named_by_program(project, after, registry))
        after.name = free_name(project, description.title, after.id);
    after.method = description.id;
    after.method_version = description.version;
    after.values = completed(description.parameters, carried(after.values));
    after.extra_values = Json::object();
    after.shaders.clear();
    for (auto& [name, preset] : after.presets) {
        preset.values = carried(preset.values);
        preset.extra_values = Json::object();
    }
    const auto label = "Change method to " + description.title;
    auto steps = following_names(project, after, is_judged_rightly(project, after, registry));
    steps.push_back(changed(project, after, label, ""));
    return group(label, std::move(steps));
}

std::vector<std::string> lost_by_method(const Project& project, const Registry& registry,
                                        const std::string& experiment, const std::string& method) {
    const auto& before = experiment_of(project, experiment);
    auto lost = carry_transport(effective(before).values, parameters_of(registry, before),
                                registry.at(method).parameters)
                    .lost;
    if (!before.shaders.empty() && before.method != method)
        lost.push_back("changed shaders (" + std::to_string(before.shaders.size()) +
                       ") are lost, as they are of the method before");
    return lost;
}

EditPtr set_scene_of(const Project& project, const std::string& experiment, const std::string& scene) {
    require_item<Scene>(project, scene, "");
    return changed(project, experiment, "Change scene", "", [&](auto& after) { after.scene = scene; });
}

EditPtr set_camera_of(const Project& project, const std::string& experiment, const std::string& camera) {
    require_item<Camera>(project, camera, "");
    return changed(project, experiment, "Change camera", "", [&](auto& after) { after.camera = camera; });
}

EditPtr set_lights_of(const Project& project, const std::string& experiment, const std::string& lights) {
    require_item<LightSet>(project, lights, scene_lights);
    return changed(project, experiment, "Change lights", "", [&](auto& after) { after.lights = lights; });
}

EditPtr set_size(const Project& project, const std::string& experiment, glm::ivec2 size) {
    return changed(project, experiment, "Change size", "size", [&](auto& after) {
        auto* preset = active_preset(after);
        (preset && preset->size ? *preset->size : after.size) = size;
    });
}

EditPtr set_seed(const Project& project, const std::string& experiment, std::uint64_t seed) {
    return changed(project, experiment, "Change seed", "seed", [&](auto& after) { after.seed = seed; });
}

EditPtr set_frames(const Project& project, const std::string& experiment, int frames) {
    return changed(project, experiment, "Change frames", "frames", [&](auto& after) {
        auto* preset = active_preset(after);
        (preset && preset->frames ? *preset->frames : after.frames) = frames;
    });
}

EditPtr set_time(const Project& project, const std::string& experiment, double seconds) {
    return changed(project, experiment, "Change time", "time", [&](auto& after) { after.time = seconds; });
}

EditPtr set_shader(const Project& project, const std::string& experiment, const std::string& file,
                   const std::string& hunks) {
    const auto label = (hunks.empty() ? "Remove change of " : "Change shader ") + printable(file, 60);
    return changed(project, experiment, label, "", [&](auto& after) {
        if (hunks.empty())
            after.shaders.erase(file);
        else
            after.shaders[file] = hunks;
    });
}

EditPtr set_experiment_notes(const Project& project, const std::string& experiment,
                             const std::string& notes) {
    return changed(project, experiment, "Change notes", "notes", [&](auto& after) { after.notes = notes; });
}

EditPtr set_reference(const Project& project, const std::string& experiment, const std::string& reference) {
    require_item<Experiment>(project, reference, "");
    if (reference == experiment) throw UsageError("an experiment cannot be its own reference");
    return changed(project, experiment, "Change reference", "",
                   [&](auto& after) { after.reference = reference; });
}

EditPtr set_active_preset(const Project& project, const std::string& experiment, const std::string& preset) {
    Experiment after = experiment_of(project, experiment);
    if (!preset.empty() && after.presets.count(preset) == 0)
        throw UsageError("experiment '" + experiment + "' has no preset '" + printable(preset) + "'");
    after.active_preset = preset;
    return changed(project, after, preset.empty() ? "Use no preset" : "Use preset '" + preset + "'", "");
}

Experiment new_experiment(const Project& project, const Registry& registry, const std::string& method,
                          const std::string& name, const std::string& scene, const std::string& camera) {
    const auto& description = registry.at(method);
    Experiment experiment;
    experiment.id = free_experiment_id(project, name.empty() ? "experiment" : name);
    experiment.name = name.empty() ? free_name(project, description.title) : name;
    experiment.scene = scene;
    experiment.camera = camera;
    experiment.method = description.id;
    experiment.method_version = description.version;
    experiment.values = defaults(description.parameters);
    return experiment;
}

}  // namespace ir::projects::edits
