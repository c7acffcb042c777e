#include "widgets/document/motion_target.h"

#include <QCoreApplication>
#include <QStringList>

#include "renderers/core/error.h"
#include "widgets/document/project_nodes.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Motion;
using projects::Project;
using Kind = Motion::Kind;

QString motion_text(const char* text) {
    return QCoreApplication::translate("Motion", text);
}

Option option_of(const Project& project, const Motion& motion) {
    return {target_id(motion), target_name(project, motion), target_id(motion)};
}

template <class List>
QString name_of(const List& list, const std::string& id) {
    const auto* item = projects::find_item(list, id);
    return q(!item || item->name.empty() ? id : item->name);
}

}  // namespace

QString target_id(const Motion& motion) {
    switch (motion.kind) {
        case Kind::camera:
            return QStringLiteral("camera:") + q(motion.camera);
        case Kind::light:
            return QStringLiteral("light:%1:%2")
                .arg(q(motion.lights),
                     motion.light_name.empty() ? QString::number(motion.light) : q(motion.light_name));
        default:
            return QStringLiteral("part:%1:%2").arg(q(motion.scene)).arg(motion.part);
    }
}

QString target_name(const Project& project, const Motion& motion) {
    switch (motion.kind) {
        case Kind::camera:
            return motion_text("Camera %1").arg(name_of(project.cameras, motion.camera));
        case Kind::light: {
            const auto* set = projects::find_item(project.lights, motion.lights);
            const auto set_name = motion.lights == projects::scene_lights
                                      ? motion_text("the scene")
                                      : name_of(project.lights, motion.lights);
            if (!motion.light_name.empty())
                return motion_text("Light %1 of %2").arg(q(motion.light_name), set_name);
            const bool known = set && std::size_t(motion.light) < set->lights.size();
            const auto type =
                known ? light_name(set->lights[std::size_t(motion.light)].type) : motion_text("Light");
            return motion_text("%1, no. %2 of %3").arg(type).arg(motion.light + 1).arg(set_name);
        }
        default: {
            const auto* scene = projects::find_item(project.scenes, motion.scene);
            const bool known = scene && std::size_t(motion.part) < scene->parts.size();
            const auto source = known ? q(scene->parts[std::size_t(motion.part)].source).section('/', -1)
                                      : motion_text("File");
            return motion_text("%1, no. %2 of %3")
                .arg(source)
                .arg(motion.part + 1)
                .arg(name_of(project.scenes, motion.scene));
        }
    }
}

std::vector<Option> motion_targets(const Project& project) {
    std::vector<Option> options;
    Motion motion;
    for (const auto& camera : project.cameras) {
        motion.camera = camera.id;
        if (camera.scene_camera.empty()) options.push_back(option_of(project, motion));
    }
    motion.kind = Kind::light;
    for (const auto& set : project.lights) {
        motion.lights = set.id;
        for (std::size_t i = 0; i < set.lights.size(); ++i) {
            motion.light = int(i);
            options.push_back(option_of(project, motion));
        }
    }
    motion.kind = Kind::part;
    for (const auto& scene : project.scenes) {
        motion.scene = scene.id;
        for (std::size_t i = 0; i < scene.parts.size(); ++i) {
            motion.part = int(i);
            options.push_back(option_of(project, motion));
        }
    }
    return options;
}

void set_target(Motion& motion, const QString& id, const Project& project) {
    const auto words = id.split(QLatin1Char(':'));
    const auto is = [&](const char* kind, int count) {
        return words[0] == QLatin1String(kind) && words.size() == count;
    };
    const auto before = motion.kind;
    Motion changed = motion;
    changed.light_name.clear();
    if (is("camera", 2)) {
        changed.kind = Kind::camera;
        changed.camera = words[1].toStdString();
    } else if (is("light", 3)) {
        changed.kind = Kind::light;
        changed.lights = words[1].toStdString();
        changed.light = words[2].toInt();
    } else if (is("part", 3)) {
        changed.kind = Kind::part;
        changed.scene = words[1].toStdString();
        changed.part = words[2].toInt();
    } else {
        throw UsageError("there is no such thing that can move");
    }
    const auto rest = key_at_rest(changed, project);
    if (changed.kind != before || changed.keys.empty()) changed.keys = {rest};
    motion = std::move(changed);
}

Motion::Key key_at_rest(const Motion& motion, const Project& project) {
    Motion::Key key;
    const auto gone = [] {
        return UsageError("what the motion moves is not in the project; choose another");
    };
    if (motion.kind == Kind::camera) {
        const auto* camera = projects::find_item(project.cameras, motion.camera);
        if (!camera || !camera->scene_camera.empty()) throw gone();
        key.aim() = *camera;
    } else if (motion.kind == Kind::light) {
        const auto* set = projects::find_item(project.lights, motion.lights);
        if (!set || std::size_t(motion.light) >= set->lights.size()) throw gone();
        const auto& light = set->lights[std::size_t(motion.light)];
        if (light.type != projects::LightSpec::Type::directional) key.position = light.position;
        key.look_at = light.target;
        if (!key.look_at) key.direction = light.direction;
    } else {
        const auto* scene = projects::find_item(project.scenes, motion.scene);
        if (!scene || std::size_t(motion.part) >= scene->parts.size()) throw gone();
        const auto& transform = scene->parts[std::size_t(motion.part)].transform;
        if (transform) key = projects::key_of(*transform);
    }
    return key;
}

}  // namespace ir::widgets
