#include "projects/set_up.h"

#include <algorithm>
#include <utility>

#include "projects/edit_steps.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

bool computes(const MethodDescription& method, const std::string& paths) {
    const auto* parameter = find(method.parameters, "paths");
    if (!parameter || method.is_reference) return false;
    const auto& supported = parameter->supported;
    return supported.empty() || std::find(supported.begin(), supported.end(), paths) != supported.end();
}

/// Whether both make the same picture, whoever they are called.
bool is_same_picture(Experiment a, const Experiment& b) {
    a.id = b.id;
    a.name = b.name;
    a.notes = b.notes;
    a.reference = b.reference;
    a.last_kept_key = b.last_kept_key;
    return a == b;
}

}  // namespace

SetUp methods_beside_truth(const Project& project, const std::string& id, const std::string& paths,
                           const Registry& registry, const AnimatedScene& is_animated) {
    const auto run = effective(experiment_of(project, id));
    EditSteps steps(project);
    SetUp result;
    for (const auto* method : registry.methods()) {
        if (!computes(*method, paths)) continue;
        auto added = edits::new_experiment(steps.after(), registry, method->id, "", run.scene, run.camera);
        added.lights = run.lights;
        added.size = run.size;
        added.seed = run.seed;
        added.frames = run.frames;
        added.time = run.time;
        added.values["paths"] = paths;
        const auto& known = project.experiments;
        const auto same = std::find_if(known.begin(), known.end(), [&](const Experiment& experiment) {
            return is_same_picture(effective(experiment), added);
        });
        if (same == known.end()) steps.add(edits::add(steps.after(), added));
        result.experiments.push_back(same == known.end() ? added.id : same->id);
    }
    for (const auto& each : std::vector(result.experiments)) {
        steps.add(match(steps.after(), each, registry, is_animated));
        const auto& truth = find_item(steps.after().experiments, each)->reference;
        auto& shown = result.experiments;
        if (std::find(shown.begin(), shown.end(), truth) == shown.end()) shown.push_back(truth);
    }
    result.edit = steps.as_one("Set up all methods for '" + paths + "'");
    return result;
}

}  // namespace ir::projects
