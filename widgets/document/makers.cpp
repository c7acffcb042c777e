#include "widgets/document/makers.h"

#include "projects/analyses.h"
#include "projects/edit_kinds.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "renderers/core/error.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/motion_target.h"
#include "widgets/document/replaced.h"

namespace ir::widgets::makers {
namespace {

using projects::EditPtr;
using projects::LightSet;
using projects::LightSpec;
using projects::Project;
using projects::Scene;
namespace edits = projects::edits;

/// "View 3": the first number that no item has yet.
template <class Item>
std::string numbered(const Project& project, const std::string& word) {
    const auto& list = edits::list_of<Item>(project);
    for (std::size_t n = 1;; ++n) {
        const std::string name = word + " " + std::to_string(n);
        const auto same = [&](const Item& item) { return item.name == name; };
        if (std::none_of(list.begin(), list.end(), same)) return name;
    }
}

/// The item with a name and a free id, at the end of its list.
template <class Item>
EditPtr added(const Project& project, Item item, const std::string& name, const std::string& word) {
    item.name = name.empty() ? numbered<Item>(project, word) : name;
    item.id = projects::free_id_in(edits::list_of<Item>(project), item.name);
    return edits::add(project, item);
}

LightSpec fresh_light(LightSpec::Type type) {
    LightSpec light;
    light.type = type;
    light.quantity = projects::allowed_quantities(type).front();
    light.amount = 10;
    light.position = {0, 2, 0};
    if (type == LightSpec::Type::directional) {
        light.position = {0, 0, 0};
        light.direction = glm::dvec3(0, -1, 0);
    } else if (type != LightSpec::Type::point) {
        light.target = glm::dvec3(0);
    }
    return light;
}

}  // namespace

EditMaker add_scene(const std::string& name, const std::string& source) {
    return [=](const Project& project) {
        Scene scene;
        scene.parts.push_back({source, "", {}});
        return added(project, scene, name, "Scene");
    };
}

EditMaker add_part(const std::string& scene, const std::string& source) {
    return [=](const Project& project) {
        Scene changed = edits::item_of<Scene>(project, scene);
        changed.parts.push_back({source, "", {}});
        return replaced(project, changed, "Add a file to scene");
    };
}

EditMaker set_part_source(const std::string& scene, int part, const std::string& source) {
    return [=](const Project& project) {
        Scene changed = edits::item_of<Scene>(project, scene);
        auto& target = changed.parts[checked_index(part, changed.parts.size(), "part")];
        if (target.source != source) target.content_hash.clear();
        target.source = source;
        return replaced(project, changed, "Change a file of scene");
    };
}

EditMaker add_camera(const CameraPose& pose, const std::string& name) {
    return [=](const Project& project) {
        projects::Camera camera;
        camera.set_pose(pose);
        return added(project, camera, name, "View");
    };
}

EditMaker set_pose(const std::string& camera, const CameraPose& pose) {
    return field_edit<projects::Camera>(
        camera, "the pose", [pose](projects::Camera& changed) { changed.set_pose(pose); }, false);
}

EditMaker add_light_set() {
    return [](const Project& project) {
        LightSet set;
        set.use_scene_lights = true;  // nothing changes until a light is added
        return added(project, set, "", "Lights");
    };
}

EditMaker add_light(const std::string& set, LightSpec::Type type) {
    return [=](const Project& project) {
        LightSet changed = edits::item_of<LightSet>(project, set);
        changed.lights.push_back(fresh_light(type));
        return replaced(project, changed, "Add a " + to_string(type) + " light to");
    };
}

EditMaker light_experiment(const std::string& experiment, const LightSpec& light) {
    return [=](const Project& project) -> EditPtr {
        const std::string label = "Add a " + to_string(light.type) + " light";
        const auto& chosen = edits::item_of<projects::Experiment>(project, experiment);
        if (const auto* present = projects::find_item(project.lights, chosen.lights)) {
            LightSet set = *present;
            set.lights.push_back(light);
            return replaced(project, set, label + " to");
        }
        Project after = project;
        std::vector<EditPtr> steps;
        const auto add = [&](EditPtr step) {
            step->apply(after);
            steps.push_back(std::move(step));
        };
        LightSet set;
        set.use_scene_lights = true;
        set.lights = {light};
        add(added(after, set, "", "Lights"));
        const auto id = after.lights.back().id;
        for (const auto& each : project.experiments)
            if (each.scene == chosen.scene && each.lights == chosen.lights)
                add(edits::set_lights_of(after, each.id, id));
        return edits::group(label, std::move(steps));
    };
}

EditMaker set_environment_map(const std::string& set, const std::string& source) {
    return field_edit<LightSet>(
        set, "the environment",
        [source](LightSet& changed) {
            changed.environment.kind = projects::Environment::Kind::map;
            if (changed.environment.source != source) changed.environment.content_hash.clear();
            changed.environment.source = source;
        },
        false);
}

EditMaker add_comparison(const std::string& a, const std::string& b) {
    return [=](const Project& project) {
        const auto& list = project.experiments;
        if (list.empty() && (a.empty() || b.empty()))
            throw UsageError("a comparison needs an experiment; add one first");
        projects::Comparison comparison;
        comparison.a = a.empty() ? list.front().id : a;
        comparison.b = b.empty() ? list[std::min<std::size_t>(1, list.size() - 1)].id : b;
        return added(project, comparison, "", "Comparison");
    };
}

EditMaker add_motion(const std::string& camera) {
    return [=](const Project& project) {
        const auto moves = [&](const projects::Camera& each) {
            return each.scene_camera.empty() && (camera.empty() || each.id == camera);
        };
        const auto found = std::find_if(project.cameras.begin(), project.cameras.end(), moves);
        if (found == project.cameras.end())
            throw UsageError("a motion needs a camera with a pose of its own; add one first");
        projects::Motion motion;
        motion.camera = found->id;
        motion.keys.emplace_back().aim() = *found;
        return added(project, motion, "", "Motion");
    };
}

EditMaker add_light_motion(const std::string& set, int light) {
    return [=](const Project& project) {
        const auto has_lights = [&](const LightSet& each) {
            return !each.lights.empty() && (set.empty() || each.id == set);
        };
        const auto found = std::find_if(project.lights.begin(), project.lights.end(), has_lights);
        if (found == project.lights.end())
            throw UsageError("a motion of a light needs a set of lights with a light; add one first");
        projects::Motion motion;
        motion.kind = projects::Motion::Kind::light;
        motion.lights = found->id;
        motion.light = std::clamp(light, 0, int(found->lights.size()) - 1);
        motion.keys = {key_at_rest(motion, project)};
        return added(project, motion, "", "Motion");
    };
}

EditMaker add_part_motion(const std::string& scene, int part) {
    return [=](const Project& project) {
        const auto fits = [&](const Scene& each) { return scene.empty() || each.id == scene; };
        const auto found = std::find_if(project.scenes.begin(), project.scenes.end(), fits);
        if (found == project.scenes.end())
            throw UsageError("a motion of a scene's file needs a scene; add one first");
        projects::Motion motion;
        motion.kind = projects::Motion::Kind::part;
        motion.scene = found->id;
        motion.part = std::clamp(part, 0, int(found->parts.size()) - 1);
        motion.keys = {key_at_rest(motion, project)};
        return added(project, motion, "", "Motion");
    };
}

EditMaker add_sweep(const std::string& experiment) {
    return [=](const Project& project) {
        if (experiment.empty() && project.experiments.empty())
            throw UsageError("a sweep needs an experiment; add one first");
        projects::Sweep sweep;
        sweep.experiment = experiment.empty() ? project.experiments.front().id : experiment;
        return added(project, sweep, "", "Sweep");
    };
}

EditMaker add_axis(const std::string& sweep, const std::string& experiment, const std::string& key) {
    return [=](const Project& project) {
        projects::Sweep changed;
        if (!sweep.empty()) changed = edits::item_of<projects::Sweep>(project, sweep);
        if (sweep.empty()) changed.experiment = experiment;
        const auto& base = projects::experiment_of(project, changed.experiment);
        const auto value = present_value(projects::effective(base), key);
        if (value.is_null()) throw UsageError("experiment '" + base.id + "' has no " + key + " to vary");
        changed.axes.push_back({key, {value}});
        return sweep.empty() ? added(project, changed, "", "Sweep") : edits::change(project, changed);
    };
}

EditMaker add_plot(const std::string& experiment) {
    return [=](const Project& project) {
        const auto& list = project.experiments;
        const auto fits = [&](const projects::Experiment& each) {
            return experiment.empty() ? !each.reference.empty() : each.id == experiment;
        };
        auto found = std::find_if(list.begin(), list.end(), fits);
        if (found == list.end()) found = list.begin();
        if (found == list.end()) throw UsageError("a plot needs an experiment; add one first");
        projects::ErrorPlot plot;
        plot.experiments = {found->id};
        plot.reference = found->reference;
        return added(project, plot, "", "Plot");
    };
}

EditMaker add_analysis(const Registry& registry, const std::string& kind, const std::string& experiment) {
    return [&registry, kind, experiment](const Project& project) {
        if (experiment.empty() && project.experiments.empty())
            throw UsageError("an analysis needs an experiment; add one first");
        const auto& id = experiment.empty() ? project.experiments.front().id : experiment;
        return projects::edits::add(project, projects::proposed_analysis(project, kind, id, registry));
    };
}

EditMaker add_image(const std::string& name, const std::string& source) {
    return [=](const Project& project) {
        projects::ForeignImage image;
        image.source = source;
        return added(project, image, name, "Image");
    };
}

EditMaker set_image_source(const std::string& image, const std::string& source) {
    return field_edit<projects::ForeignImage>(
        image, "the file",
        [source](projects::ForeignImage& changed) {
            if (changed.source != source) changed.content_hash.clear();
            changed.source = source;
        },
        false);
}

}  // namespace ir::widgets::makers
