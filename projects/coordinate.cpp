#include "projects/coordinate.h"

#include <utility>

#include "projects/document_fields.h"
#include "projects/text.h"
#include "projects/value_reader.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

void set_parameter(Experiment& e, const MethodDescription& method, const std::string& key, const Json& json) {
    const auto* parameter = find(method.parameters, key);
    if (!parameter) {
        std::string general;
        for (const auto& known : general_keys())
            general += (general.empty() ? "" : known == general_keys().back() ? " or " : ", ") + known;
        throw UsageError("'" + printable(key, 60) + "' is neither a parameter of " + method.id + " nor " +
                         general);
    }
    const auto value = to_value(json);
    if (!value) throw UsageError("parameter '" + key + "' needs plain values");
    e.values[key] = parameter->checked(*value);
}

template <class List>
std::string known_id(const List& list, const Json& json, const std::string& none, const std::string& key) {
    if (json.is_string() && (json == none || find_item(list, json.get<std::string>()))) return json;
    throw UsageError("'" + printable(canonical_json(json), 60) + "' is no id for " + key);
}

/// The readers' messages already name the key.
void set_coordinate(Experiment& e, const Project& project, const MethodDescription& method,
                    const std::string& key, const Json& json) {
    const Json object = Json::object({{key, json}});
    const std::string file = "value";
    ObjectReader reader(object, file, "");
    if (const auto* field = find_field(experiment_fields(), key))
        read_value(reader, field->text, field->slot(e));
    else if (key == "scene")
        e.scene = known_id(project.scenes, json, "", key);
    else if (key == "camera")
        e.camera = known_id(project.cameras, json, "", key);
    else if (key == "lights")
        e.lights = known_id(project.lights, json, scene_lights, key);
    else
        set_parameter(e, method, key, json);
}

}  // namespace

const std::vector<std::string>& general_keys() {
    static const auto keys = [] {
        std::vector<std::string> result;
        for (const auto& field : experiment_fields()) result.push_back(field.text.key);
        result.insert(result.end(), {"camera", "lights", "scene"});
        return result;
    }();
    return keys;
}

Experiment with_coordinate(const Project& project, const Experiment& experiment, const std::string& key,
                           const Json& value, const Registry& registry) {
    Experiment result = effective(experiment);
    result.last_kept_key.clear();
    try {
        set_coordinate(result, project, registry.at(result.method), key, value);
    } catch (const Error& error) {
        throw UsageError(printable(error.what(), 300));
    }
    return result;
}

namespace edits {
namespace {

/// `changed` has the new value.
EditPtr set_coordinate(const Project& project, const Registry& registry, const Experiment& changed,
                       const std::string& key) {
    const auto& id = changed.id;
    if (key == "size") return set_size(project, id, changed.size);
    if (key == "seed") return set_seed(project, id, changed.seed);
    if (key == "frames") return set_frames(project, id, changed.frames);
    if (key == "time") return set_time(project, id, changed.time);
    if (key == "camera") return set_camera_of(project, id, changed.camera);
    if (key == "lights") return set_lights_of(project, id, changed.lights);
    if (key == "scene") return set_scene_of(project, id, changed.scene);
    return set_values(project, registry, id, {{key, changed.values.at(key)}});
}

}  // namespace

EditPtr set_coordinates(const Project& project, const Registry& registry, const std::string& experiment,
                        const Json& coordinates, const std::string& label) {
    auto now = project;
    std::vector<EditPtr> steps;
    for (const auto& [key, value] : coordinates.items()) {
        const auto* item = find_item(now.experiments, experiment);
        if (!item) throw UsageError("there is no experiment '" + printable(experiment, 60) + "' any more");
        const auto changed = with_coordinate(now, *item, key, value, registry);
        steps.push_back(set_coordinate(now, registry, changed, key));
        steps.back()->apply(now);  // the next one is made against it
    }
    return group(label, std::move(steps));
}

}  // namespace edits
}  // namespace ir::projects
