#include <sstream>

#include "projects/document_fields.h"
#include "projects/document_json.h"
#include "projects/motion.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

/// Known members stand first, in a fixed order; those that this build does not know follow as they were.
Json with_extra(Json json, const Json& extra) {
    for (auto it = extra.begin(); it != extra.end(); ++it)
        if (!json.contains(it.key())) json[it.key()] = *it;
    return json;
}

Json array(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json to_json(const Value& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

void put_unless_empty(Json& json, const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
}

template <class Item, class Write>
Json list(const std::vector<Item>& items, Write write) {
    Json result = Json::array();
    for (const auto& item : items) result.push_back(write(item));
    return result;
}

Json write_part(const ScenePart& part) {
    Json json = Json::object();
    write_fields(json, part, part_fields());
    if (part.transform) json["transform"] = *part.transform;
    for (const auto& [name, change] : part.materials)
        json["materials"][name] = with_extra(to_json(change), change.extra);
    return with_extra(json, part.extra);
}

Json write_scene(const Scene& scene) {
    Json json = Json::object({{"id", scene.id}, {"name", scene.name}});
    json["parts"] = list(scene.parts, write_part);
    return with_extra(json, scene.extra);
}

/// An item that is nothing but its fields.
template <class Item>
auto write_with(const Fields<Item>& fields) {
    return [&fields](const Item& item) {
        Json json = Json::object({{"id", item.id}, {"name", item.name}});
        write_fields(json, item, fields);
        return with_extra(json, item.extra);
    };
}

Json write_environment(const Environment& environment) {
    if (environment.kind == Environment::Kind::scene) return "scene";
    if (environment.kind == Environment::Kind::constant) return array(environment.constant);
    Json json = Json::object();
    write_fields(json, environment, map_fields());
    return with_extra(json, environment.extra);
}

Json write_light_set(const LightSet& set) {
    Json json = Json::object({{"id", set.id}, {"name", set.name}});
    Json lights = Json::array();
    if (set.use_scene_lights) lights.push_back(scene_lights);
    for (std::size_t i = 0; i < set.lights.size(); ++i) {
        const Json none = Json::object();
        const auto& extra = i < set.light_extras.size() ? set.light_extras[i] : none;
        lights.push_back(with_extra(to_json(set.lights[i]), extra));
    }
    const bool is_scenes = set.use_scene_lights && set.lights.empty();
    json["lights"] = is_scenes ? Json(scene_lights) : std::move(lights);
    json["environment"] = write_environment(set.environment);
    return with_extra(json, set.extra);
}

Json write_key(const Motion::Key& key, Motion::Kind kind) {
    Json json = Json::object();
    write_fields(json, key, key_fields(kind));
    return with_extra(json, key.extra);
}

Json write_motion(const Motion& motion) {
    Json json = Json::object({{"id", motion.id}, {"name", motion.name}, {"moves", to_string(motion.kind)}});
    write_fields(json, motion, motion_fields(motion.kind));
    if (motion.kind == Motion::Kind::light)
        json["light"] = motion.light_name.empty() ? Json(motion.light) : Json(motion.light_name);
    if (motion.loop) json["loop"] = true;
    if (motion.smooth) json["smooth"] = true;
    json["keys"] = list(motion.keys, [&](const Motion::Key& key) { return write_key(key, motion.kind); });
    return with_extra(json, motion.extra);
}

/// Hunks as their lines, so that people can read them.
Json write_shaders(const ShaderChanges& shaders) {
    Json json = Json::object();
    for (const auto& [file, hunks] : shaders) {
        auto& lines = json[file] = Json::array();
        std::istringstream text(hunks);
        for (std::string line; std::getline(text, line);) lines.push_back(line);
    }
    return json;
}

/// The groups "transport" and "values".
void put_values(Json& json, const Settings& values, const Json& extra_values, const Json& extra_transport) {
    Json transport = Json::object(), own = Json::object();
    for (const auto& [key, value] : values) (is_transport_key(key) ? transport : own)[key] = to_json(value);
    for (auto it = extra_values.begin(); it != extra_values.end(); ++it)
        (is_transport_key(it.key()) ? transport : own)[it.key()] = *it;
    json["transport"] = with_extra(transport, extra_transport);
    json["values"] = own;
}

Json write_preset(const Preset& preset) {
    Json json = Json::object();
    write_fields(json, preset, preset_fields());
    put_values(json, preset.values, preset.extra_values, preset.extra_transport);
    if (json["transport"].empty()) json.erase("transport");
    if (json["values"].empty()) json.erase("values");
    return with_extra(json, preset.extra);
}

Json write_experiment(const Experiment& e) {
    Json json = Json::object({{"id", e.id}, {"name", e.name}});
    put_unless_empty(json, "notes", e.notes);
    json["scene"] = e.scene;
    json["camera"] = e.camera;
    json["lights"] = e.lights;
    json["method"] = e.method;
    json["method_version"] = e.method_version;
    put_values(json, e.values, e.extra_values, e.extra_transport);
    if (!e.shaders.empty()) json["shaders"] = write_shaders(e.shaders);
    write_fields(json, e, experiment_fields());
    put_unless_empty(json, "reference", e.reference);
    put_unless_empty(json, "active_preset", e.active_preset);
    for (const auto& [name, preset] : e.presets) json["presets"][name] = write_preset(preset);
    return with_extra(json, e.extra);
}

Json write_sweep(const Sweep& sweep) {
    Json json = Json::object({{"id", sweep.id}, {"name", sweep.name}});
    write_fields(json, sweep, sweep_fields());
    json["axes"] = list(sweep.axes, [](const Sweep::Axis& axis) {
        Json fields = Json::object();
        write_fields(fields, axis, axis_fields());
        return with_extra(fields, axis.extra);
    });
    return with_extra(json, sweep.extra);
}

}  // namespace

Json to_json(const LightSpec& light) {
    Json fields = Json::object();
    write_fields(fields, light, light_fields());
    Json json = Json::object({{"type", to_string(light.type)}});
    for (auto it = fields.begin(); it != fields.end(); ++it) {
        if (it.key() == "color") json[quantity_text(light.quantity).key] = light.amount;
        json[it.key()] = *it;
    }
    return json;
}

Json key_inputs(const Motion::Key& key, Motion::Kind kind) {
    auto values = key;
    values.extra = Json::object();
    auto json = write_key(values, kind);
    json.erase("time");
    return json;
}

Json motion_inputs(const Motion& motion) {
    Json json = Json::object({{"loop", motion.loop}});
    if (motion.smooth) json["smooth"] = true;
    json["keys"] = list(motion.keys, [&](const Motion::Key& key) {
        auto values = key_inputs(key, motion.kind);
        values["time"] = key.time;
        return values;
    });
    return json;
}

Json to_json(const MaterialOverride& change) {
    Json json = Json::object();
    write_fields(json, change, material_fields());
    return json;
}

Json pose_json(const CameraPose& pose) {
    Camera camera;
    camera.set_pose(pose);
    Json json = Json::object();
    for (const auto& field : camera_fields())
        if (const auto numbers = numbers_of(field.slot(camera)); !numbers.empty() && field.counts_in(camera))
            json[field.text.key] = numbers.size() > 1 ? Json(numbers) : Json(numbers.front());
    return json;
}

Json to_json(const Project& project) {
    Json json = Json::object({{"schema", project.schema}, {"name", project.name}, {"notes", project.notes}});
    json["scenes"] = list(project.scenes, write_scene);
    json["cameras"] = list(project.cameras, write_with(camera_fields()));
    json["lights"] = list(project.lights, write_light_set);
    json["motion"] = list(project.motion, write_motion);
    json["images"] = list(project.images, write_with(image_fields()));
    json["experiments"] = list(project.experiments, write_experiment);
    json["comparisons"] = list(project.comparisons, write_with(comparison_fields()));
    json["sweeps"] = list(project.sweeps, write_sweep);
    json["plots"] = list(project.plots, write_with(plot_fields()));
    if (!project.analyses.empty())  // older builds do not know them
        json["analyses"] = list(project.analyses, write_with(analysis_fields()));
    if (!project.shaders_allowed) json["shaders_allowed"] = false;
    return with_extra(json, project.extra);
}

std::string write_project(const Project& project) {
    return pretty_json(to_json(project));
}

}  // namespace ir::projects
