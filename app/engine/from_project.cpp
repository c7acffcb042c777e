#include "app/engine/from_project.h"

#include <memory>
#include <optional>

#include "app/engine/camera_pose.h"
#include "app/engine/execution.h"
#include "projects/check.h"
#include "projects/document.h"
#include "projects/document_json.h"
#include "projects/motion.h"
#include "projects/recipe.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/image/exr.h"

namespace ir::engine {
namespace {

scene::LightType type_of(projects::LightSpec::Type type) {
    using Type = projects::LightSpec::Type;
    switch (type) {
        case Type::point:
            return scene::LightType::point;
        case Type::spot:
            return scene::LightType::spot;
        case Type::directional:
            return scene::LightType::directional;
        case Type::rect:
            return scene::LightType::rectangle;
        default:
            return scene::LightType::disk;
    }
}

glm::mat4 matrix_of(const std::array<double, 16>& numbers) {
    glm::mat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = static_cast<float>(numbers[std::size_t(i)]);
    return matrix;
}

scene::PartMotion to_part_motion(const projects::Motion& motion) {
    scene::PartMotion result;
    result.loop = motion.loop;
    for (const auto& key : motion.keys)
        result.keys.push_back({static_cast<float>(key.time), key.translation,
                               glm::quat(projects::rotation_of(key.rotation)), key.scale});
    return result;
}

scene::Part to_scene_part(const projects::ScenePart& part, const projects::Motion* motion,
                          const std::filesystem::path& folder) {
    scene::Part result;
    result.source = projects::loadable_source(part.source, folder);
    if (motion && projects::is_moving(*motion))
        result.motion = to_part_motion(*motion);
    else if (motion)
        result.transform = matrix_of(projects::transform_of(motion->keys.front()));
    else if (part.transform)
        result.transform = matrix_of(*part.transform);
    result.materials.insert(part.materials.begin(), part.materials.end());
    result.variant = part.variant;
    return result;
}

/// The motion as a picture of one moment needs it.
projects::Motion frozen(projects::Motion motion, double time) {
    motion.keys = {projects::key_at(motion, time)};
    return motion;
}

void set_camera(Experiment& result, const projects::Project& project, const std::string& id, bool lasts) {
    if (id.empty()) return;
    const auto* item = projects::find_item(project.cameras, id);
    if (!item) throw Error("experiment uses camera '" + id + "', which the project does not have");
    if (!item->scene_camera.empty()) {
        result.camera_name = item->scene_camera;
        return;
    }
    const auto posed = projects::camera_at(project, *item, result.time);
    result.camera = camera_of(posed);
    result.camera->name = posed.name;
    const auto* motion = projects::motion_of_camera(project, id);
    if (lasts && motion && projects::is_moving(*motion)) result.camera_motion = *motion;
}

void add_light(Experiment& result, const projects::Motion* motion, const projects::LightSpec& spec,
               const std::string& name, bool lasts) {
    if (motion && lasts && projects::is_moving(*motion))
        result.light_motions.push_back({result.lights.size(), "", spec, *motion});
    const auto now = motion ? projects::light_at(spec, projects::key_at(*motion, result.time)) : spec;
    result.lights.push_back(to_scene_light(now, name));
}

/// Lights of the scene's file have nothing but their names here.
void move_scene_lights(Experiment& result, const projects::Project& project, const std::string& id,
                       bool lasts) {
    for (const auto& motion : project.motion)
        if (projects::motion_of_light(project, id, motion.light_name) == &motion)
            result.light_motions.push_back(
                {0, motion.light_name, {}, lasts ? motion : frozen(motion, result.time)});
}

void set_lights(Experiment& result, const projects::Project& project, const std::string& id,
                const std::filesystem::path& folder, const std::optional<scene::Environment>& map,
                bool lasts) {
    if (id == projects::scene_lights) return move_scene_lights(result, project, id, lasts);
    const auto* set = projects::find_item(project.lights, id);
    if (!set) throw Error("experiment uses lights '" + id + "', which the project does not have");
    result.replace_lights = !set->use_scene_lights;
    for (const auto& spec : set->lights) {
        const auto number = result.lights.size();
        add_light(result, projects::motion_of_light(project, id, static_cast<int>(number)), spec,
                  set->name + " " + std::to_string(number + 1), lasts);
    }
    if (set->use_scene_lights) move_scene_lights(result, project, id, lasts);
    using Kind = projects::Environment::Kind;
    const auto& environment = set->environment;
    if (environment.kind == Kind::constant) {
        result.environment = scene::Environment{glm::vec3(environment.constant), nullptr};
    } else if (environment.kind == Kind::map) {
        result.environment = map ? *map
                                 : scene::map_environment(std::make_shared<Image>(
                                       read_image(projects::resolve(environment.source, folder))));
    }
}

}  // namespace

scene::Light to_scene_light(const projects::LightSpec& spec, const std::string& name) {
    scene::Light light;
    light.name = name;
    light.type = type_of(spec.type);
    light.colour = spec.color;
    light.intensity = static_cast<float>(spec.intensity());
    light.position = spec.position;
    light.direction = spec.travel();
    light.inner_angle = static_cast<float>(glm::radians(spec.inner));
    light.outer_angle = static_cast<float>(glm::radians(spec.outer));
    light.size = spec.size;
    return light;
}

Experiment from_project(const projects::Project& project, const projects::Experiment& chosen,
                        const std::filesystem::path& folder, const std::optional<scene::Environment>& map) {
    const auto experiment = projects::effective(chosen);
    const auto* scene = projects::find_item(project.scenes, experiment.scene);
    if (!scene)
        throw Error("experiment '" + chosen.id + "' uses scene '" + experiment.scene +
                    "', which the project does not have");
    if (const auto why = projects::why_shaders_wait(project, experiment); !why.empty())
        throw Error("experiment '" + chosen.id + "': " + why);
    Experiment result;
    for (const auto& part : scene->parts) {
        const auto number = static_cast<int>(result.parts.size());
        const auto* motion = projects::motion_of_part(project, scene->id, number);
        result.parts.push_back(to_scene_part(part, motion, folder));
    }
    result.scene = scene::composition_name(result.parts);
    result.method = experiment.method;
    result.shaders = experiment.shaders;
    const auto* method = registry().find(experiment.method);
    // Values of a method that this build lacks cannot be checked; whoever runs it hears of that.
    result.settings = method ? projects::runnable_settings(chosen, *method) : experiment.values;
    result.width = experiment.size.x;
    result.height = experiment.size.y;
    result.seed = experiment.seed;
    result.frames = experiment.frames;
    result.time = experiment.time;
    // What adds up over frames is a picture of one moment, in which camera and lights stand still.
    const bool lasts = !method || !projects::accumulates(*method);
    set_camera(result, project, experiment.camera, lasts);
    set_lights(result, project, experiment.lights, folder, map, lasts);
    auto recipe = projects::recipe_of(project, chosen, folder);
    recipe.experiments.front().values = result.settings;  // whatever defaults will be
    result.recipe = projects::to_json(recipe).dump();
    return result;
}

projects::Project project_of(const std::string& scene, const std::string& method) {
    const auto& description = registry().at(method);
    projects::Project project;
    projects::Experiment experiment;
    project.scenes = {{"scene", "scene", {{scene, {}, {}}}}};
    experiment.id = experiment.name = description.id;
    experiment.scene = "scene";
    experiment.method = description.id;
    experiment.method_version = description.version;
    experiment.size = {800, 600};
    experiment.seed = 0;
    project.experiments = {experiment};
    return project;
}

Experiment from_single(const projects::Project& project) {
    auto experiment = from_project(project, project.experiments.front(), {});
    const auto& part = project.scenes.front().parts.front();
    experiment.scene = part.source;
    if (part.variant.empty()) experiment.parts.clear();  // the scene as it is
    return experiment;
}

void choose_camera(projects::Project& project, projects::Experiment& experiment, const std::string& name) {
    if (find_item(project.cameras, name)) {
        experiment.camera = name;
        return;
    }
    projects::Camera camera;
    camera.name = camera.scene_camera = name;
    add_camera(project, experiment, std::move(camera));
}

void add_camera(projects::Project& project, projects::Experiment& experiment, projects::Camera camera) {
    camera.id = free_id_in(project.cameras, camera.name);
    experiment.camera = camera.id;
    project.cameras.push_back(std::move(camera));
}

}  // namespace ir::engine
