#include "projects/results.h"

#include <algorithm>

#include "projects/document_json.h"
#include "projects/hash.h"
#include "projects/motion.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "projects/text.h"

namespace ir::projects {
namespace {

Json content_of(const std::string& source, const std::string& content_hash) {
    // Built-in scenes are what their name, version and options say, recorded hash or not.
    if (is_builtin(source)) return scene_hash(source, {});
    // A file whose hash is not known yet is at least told apart by its path.
    return content_hash.empty() ? Json("source " + source) : Json(content_hash);
}

/// What a picture sees: one moment, or how things move from there on.
struct Sight {
    double time = 0;     ///< seconds
    bool lasts = false;  ///< several frames of different moments
};

/// A motion as far as a picture depends on it, beside what it gives at the sight's time.
void put_motion(Json& inputs, const Motion* motion, const Sight& sight) {
    if (!motion || !sight.lasts || !is_moving(*motion)) return;
    inputs["motion"] = motion_inputs(*motion);
}

Json scene_inputs(const Project& project, const std::string& id, const Sight& sight) {
    const auto* scene = find_item(project.scenes, id);
    if (!scene) return "missing " + id;
    Json parts = Json::array();
    for (const auto& part : scene->parts) {
        Json json = Json::object({{"content", content_of(part.source, part.content_hash)}});
        const auto* motion = motion_of_part(project, id, static_cast<int>(parts.size()));
        if (motion)
            json["transform"] = transform_of(key_at(*motion, sight.time));
        else if (part.transform)
            json["transform"] = *part.transform;
        put_motion(json, motion, sight);
        if (!part.variant.empty()) json["variant"] = part.variant;
        for (const auto& [name, change] : part.materials)
            if (auto members = to_json(change); !members.empty())
                json["materials"][name] = std::move(members);
        parts.push_back(std::move(json));
    }
    return parts;
}

Json vector_of(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json camera_inputs(const Project& project, const Experiment& experiment, const Sight& sight) {
    if (experiment.camera.empty()) return "first of the scene";
    const auto* camera = find_item(project.cameras, experiment.camera);
    if (!camera) return "missing " + experiment.camera;
    if (!camera->scene_camera.empty()) return Json::object({{"scene_camera", camera->scene_camera}});
    Json json = pose_json(camera_at(project, *camera, sight.time));
    put_motion(json, motion_of_camera(project, camera->id), sight);
    return json;
}

Json environment_inputs(const Environment& environment) {
    switch (environment.kind) {
        case Environment::Kind::scene:
            return "scene";
        case Environment::Kind::constant:
            return vector_of(environment.constant);
        case Environment::Kind::map:
            return content_of(environment.source, environment.content_hash);
    }
    return nullptr;
}

/// Motions of lights that the scene's file has, by their names.
void put_scene_lights(Json& inputs, const Project& project, const std::string& id, const Sight& sight) {
    for (const auto& motion : project.motion) {
        const auto& name = motion.light_name;
        if (motion_of_light(project, id, name) != &motion) continue;
        auto& json = inputs["light_motion"][name] = Json::object();
        json["at"] = key_inputs(key_at(motion, sight.time), motion.kind);
        put_motion(json, &motion, sight);
    }
}

void put_lighting(Json& inputs, const Project& project, const std::string& id, const Sight& sight) {
    const auto* set = find_item(project.lights, id);
    if (id == scene_lights || (set && set->use_scene_lights)) put_scene_lights(inputs, project, id, sight);
    if (id == scene_lights || !set) {
        inputs["lights"] = set || id == scene_lights ? id : "missing " + id;
        inputs["environment"] = "scene";
        return;
    }
    Json lights = Json::array();
    if (set->use_scene_lights) lights.push_back(scene_lights);
    for (std::size_t i = 0; i < set->lights.size(); ++i) {
        const auto* motion = motion_of_light(project, id, static_cast<int>(i));
        auto json = to_json(motion ? light_at(set->lights[i], key_at(*motion, sight.time)) : set->lights[i]);
        put_motion(json, motion, sight);
        lights.push_back(std::move(json));
    }
    const bool is_scenes = set->use_scene_lights && set->lights.empty();
    inputs["lights"] = is_scenes ? Json(scene_lights) : std::move(lights);
    inputs["environment"] = environment_inputs(set->environment);
}

void put_method(Json& inputs, const Experiment& run, const Registry& registry) {
    const auto* method = registry.find(run.method);
    inputs["method"] = run.method;
    inputs["method_version"] = method ? method->version : run.method_version;
    Json values = Json::object();
    // A known method never sees the keys that it does not know: they are no inputs.
    Settings inputs_of_method = method ? defaults(method->parameters) : run.values;
    for (auto& [key, value] : inputs_of_method) {
        if (const auto given = run.values.find(key); given != run.values.end()) value = given->second;
        values[key] = std::visit([](const auto& v) { return Json(v); }, value);
    }
    inputs["values"] = std::move(values);
}

/// What the build's own shaders are not.
void put_shaders(Json& inputs, const Experiment& run) {
    for (const auto& [file, hunks] : run.shaders) inputs["shaders"][file] = change_text(hunks);
    if (const auto folder = shader_folder_digest(); !folder.empty()) inputs["shader_folder"] = folder;
}

std::string shown(const Json& json) {
    return printable(json.is_string() ? json.get<std::string>() : canonical_json(json));
}

void compare(const std::string& path, const Json& before, const Json& now, std::vector<std::string>& out) {
    if (!before.is_object() || !now.is_object()) {
        if (before != now) out.push_back(path + ": " + shown(before) + " → " + shown(now));
        return;
    }
    const auto inner = [&](const std::string& key) {
        return (path.empty() ? "" : path + ".") + printable(key);
    };
    for (auto it = before.begin(); it != before.end(); ++it) {
        if (now.contains(it.key()))
            compare(inner(it.key()), *it, now.at(it.key()), out);
        else
            out.push_back(inner(it.key()) + ": " + shown(*it) + " → nothing");
    }
    for (auto it = now.begin(); it != now.end(); ++it)
        if (!before.contains(it.key())) out.push_back(inner(it.key()) + ": nothing → " + shown(*it));
}

Json sight_inputs(const Project& project, const Experiment& run, const Sight& sight) {
    Json inputs = Json::object({{"scene", scene_inputs(project, run.scene, sight)}});
    inputs["camera"] = camera_inputs(project, run, sight);
    put_lighting(inputs, project, run.lights, sight);
    return inputs;
}

}  // namespace

Json moment_inputs(const Project& project, const Experiment& experiment, double time) {
    const Experiment run = effective(experiment);
    auto inputs = sight_inputs(project, run, {time, false});
    inputs["size"] = Json::array({run.size.x, run.size.y});
    return inputs;
}

Json picture_inputs(const Project& project, const Experiment& experiment, const Registry& registry) {
    const Experiment run = effective(experiment);
    auto inputs = sight_inputs(project, run, {run.time, last_time(run, registry) > run.time});
    put_method(inputs, run, registry);
    put_shaders(inputs, run);
    inputs["size"] = Json::array({run.size.x, run.size.y});
    inputs["seed"] = run.seed;
    inputs["frames"] = run.frames;
    inputs["time"] = run.time;
    return inputs;
}

std::string result_key(const Project& project, const Experiment& experiment, const Registry& registry) {
    return hash_json(picture_inputs(project, experiment, registry));
}

Json state_inputs(const Project& project, const Experiment& experiment, const Registry& registry) {
    auto inputs = picture_inputs(project, experiment, registry);
    inputs.erase("frames");
    if (const auto* method = registry.find(experiment.method))
        for (const auto& parameter : method->parameters)
            if (parameter.accumulates) inputs["values"].erase(parameter.key);
    return inputs;
}

std::string state_key(const Project& project, const Experiment& experiment, const Registry& registry) {
    return hash_json(state_inputs(project, experiment, registry));
}

ResultState result_state(const Project& project, const Experiment& experiment, const Registry& registry) {
    if (experiment.last_kept_key.empty()) return ResultState::none;
    return experiment.last_kept_key == result_key(project, experiment, registry) ? ResultState::current
                                                                                 : ResultState::stale;
}

bool is_stale(const Project& project, const Experiment& experiment, const Registry& registry,
              const ContentHashes& contents) {
    if (experiment.last_kept_key.empty()) return false;
    return result_state(with_contents(project, contents), experiment, registry) == ResultState::stale;
}

std::vector<std::string> stale_experiments(const Project& project, const Registry& registry,
                                           const ContentHashes& contents) {
    std::vector<std::string> stale;
    const Project now = with_contents(project, contents);
    for (const auto& experiment : now.experiments)
        if (result_state(now, experiment, registry) == ResultState::stale) stale.push_back(experiment.id);
    return stale;
}

std::vector<std::string> differences(const Json& inputs_before, const Json& inputs_now) {
    std::vector<std::string> result;
    compare("", inputs_before, inputs_now, result);
    return result;
}

}  // namespace ir::projects
