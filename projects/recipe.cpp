#include "projects/recipe.h"

#include "projects/scene_files.h"

namespace ir::projects {

Project recipe_of(const Project& project, const Experiment& chosen, const std::filesystem::path& folder) {
    Project recipe;
    recipe.name = project.name;
    auto experiment = effective(chosen);
    experiment.reference.clear();
    experiment.last_kept_key.clear();
    if (const auto* scene = find_item(project.scenes, experiment.scene)) recipe.scenes = {*scene};
    if (const auto* camera = find_item(project.cameras, experiment.camera)) recipe.cameras = {*camera};
    if (const auto* lights = find_item(project.lights, experiment.lights)) recipe.lights = {*lights};
    for (const auto& motion : project.motion)
        if ((!motion.camera.empty() && motion.camera == experiment.camera) ||
            (!motion.lights.empty() && motion.lights == experiment.lights) ||
            (!motion.scene.empty() && motion.scene == experiment.scene))
            recipe.motion.push_back(motion);
    for_each_file(recipe,
                  [&](std::string& source, const std::string&) { source = loadable_source(source, folder); });
    recipe.experiments = {std::move(experiment)};
    return recipe;
}

}  // namespace ir::projects
