#include "app/engine/moving.h"

#include <algorithm>

#include "app/engine/execution.h"
#include "app/engine/from_project.h"
#include "projects/document_json.h"
#include "projects/motion.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/scene/light_sources.h"

namespace ir::engine {
namespace {

/// A light of the scene's file as a key says; what the key does not say stays.
void move(scene::Light& light, const projects::Motion::Key& key) {
    light.intensity *= static_cast<float>(key.intensity);
    if (key.position) light.position = *key.position;
    const auto direction = key.look_at ? glm::vec3(*key.look_at) - light.position
                                       : glm::vec3(key.direction.value_or(glm::dvec3(light.direction)));
    if (glm::length(direction) > 0) light.direction = glm::normalize(direction);
}

}  // namespace

projects::SceneFacts scene_facts(SceneCache& cache, const projects::Project& project,
                                 const std::filesystem::path& folder) {
    projects::SceneFacts facts;
    facts.is_animated = [&cache, &project, folder](const std::string& id) {
        const auto* scene = projects::find_item(project.scenes, id);
        return scene && std::any_of(scene->parts.begin(), scene->parts.end(), [&](const auto& part) {
                   try {
                       return cache.load(projects::loadable_source(part.source, folder))->is_animated();
                   } catch (const Error&) {
                       return false;
                   }
               });
    };
    facts.light_sources = [&cache, &project, folder](const projects::Experiment& experiment) {
        try {
            const auto run = from_project(project, experiment, folder);
            const auto scene = cache.load(run.composition());
            return scene::light_sources(*scene, run.lights_with(scene->lights),
                                        run.environment.value_or(scene->environment));
        } catch (const Error&) {
            return std::vector<LightSource>();
        }
    };
    return facts;
}

bool is_moving(const Experiment& experiment) {
    const auto moves = [](const LightMotion& light) { return projects::is_moving(light.motion); };
    return experiment.camera_motion.has_value() ||
           std::any_of(experiment.light_motions.begin(), experiment.light_motions.end(), moves);
}

scene::Camera camera_at(const Experiment& experiment, double time) {
    auto camera = *experiment.camera;
    if (!experiment.camera_motion) return camera;
    const auto pose = projects::key_at(*experiment.camera_motion, time);
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    return camera;
}

std::vector<scene::Light> lights_at(const Experiment& experiment, std::vector<scene::Light> lights,
                                    double time) {
    for (const auto& moving : experiment.light_motions) {
        const auto key = projects::key_at(moving.motion, time);
        if (moving.name.empty()) {
            auto& light = lights.at(moving.light);
            light = to_scene_light(projects::light_at(moving.spec, key), light.name);
            continue;
        }
        for (auto& light : lights)
            if (light.name == moving.name) move(light, key);
    }
    return lights;
}

std::string motion_text(const Experiment& experiment) {
    std::string text;
    if (experiment.camera_motion)
        text += "camera " + projects::canonical_json(projects::motion_inputs(*experiment.camera_motion));
    for (const auto& light : experiment.light_motions)
        text += "light " + std::to_string(light.light) + ' ' + light.name + ' ' + to_string(light.spec) +
                projects::canonical_json(projects::motion_inputs(light.motion));
    return text;
}

}  // namespace ir::engine
