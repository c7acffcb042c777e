#include "app/gui/experiment_camera.h"

#include <algorithm>
#include <utility>

#include "app/engine/camera_pose.h"
#include "app/gui/session.h"
#include "projects/motion.h"

namespace ir::gui {
namespace {

projects::Camera posed(projects::Camera camera, const widgets::CameraPose& pose) {
    camera.set_pose(pose);
    return camera;
}

/// Whether the pose can be changed in place: a pose of its own that no motion overrides.
bool is_movable(const projects::Project& project, const projects::Camera* camera) {
    return camera && camera->scene_camera.empty() && !projects::motion_of_camera(project, camera->id);
}

/// The experiments' cameras changed in place, or a new one for all whose camera cannot be, as one step.
projects::EditPtr move_cameras(const projects::Project& project, const std::vector<std::string>& experiments,
                               const widgets::CameraPose& pose) {
    projects::Project after = project;
    std::vector<projects::EditPtr> steps;
    const auto add = [&](projects::EditPtr step) {
        step->apply(after);
        steps.push_back(std::move(step));
    };
    std::string fresh;
    for (const auto& id : experiments) {
        const auto* experiment = projects::find_item(after.experiments, id);
        if (!experiment) continue;
        const auto* camera = projects::find_item(after.cameras, experiment->camera);
        if (is_movable(after, camera)) {
            auto step = projects::edits::change(after, posed(*camera, pose));
            if (!step->changes_nothing()) add(std::move(step));
            continue;
        }
        if (fresh.empty()) {
            const auto view = new_view(after, pose, "View");
            fresh = view.id;
            add(projects::edits::add(after, view));
        }
        add(projects::edits::set_camera_of(after, id, fresh));
    }
    if (steps.size() == 1) return std::move(steps.front());
    return projects::edits::group("Move camera", std::move(steps));
}

}  // namespace

projects::Camera new_view(const projects::Project& project, const widgets::CameraPose& pose,
                          const std::string& name) {
    projects::Camera camera = posed({}, pose);
    camera.id = projects::free_id_in(project.cameras, name);
    const auto number = camera.id.find_last_not_of("0123456789") + 1;
    camera.name = number < camera.id.size() ? name + " " + camera.id.substr(number) : name;
    return camera;
}

std::optional<widgets::CameraPose> ExperimentCamera::pose() const {
    const auto* chosen = session_.experiment();
    if (!chosen) return {};
    if (const auto moved = moved_pose(chosen->id)) return moved;
    const auto& document = session_.document();
    const auto* camera = projects::find_item(document.cameras, chosen->camera);
    if (camera && camera->scene_camera.empty())
        return projects::camera_at(document, *camera, shown_time_.value_or(chosen->time));
    if (camera)
        for (const auto& each : scene_cameras_)
            if (each.name == camera->scene_camera) return engine::pose_of(each);
    if (scene_cameras_.empty()) return {};
    return engine::pose_of(scene_cameras_.front());
}

std::optional<widgets::CameraPose> ExperimentCamera::moved_pose(const std::string& id) const {
    return std::find(moved_.begin(), moved_.end(), id) == moved_.end() ? std::nullopt : moved_pose_;
}

void ExperimentCamera::move(const std::string& id, const widgets::CameraPose& pose,
                            const std::vector<std::string>& others) {
    if (!session_.experiment(id)) return;
    moved_pose_ = pose;
    moved_ = {id};
    for (const auto& other : others)
        if (other != id && session_.experiment(other)) moved_.push_back(other);
    emit moved();
}

void ExperimentCamera::forget_move() {
    moved_pose_.reset();
    moved_.clear();
}

void ExperimentCamera::finish_move() {
    // Read-only: one may look around, nothing is written.
    if (!moved_pose_ || !session_.has_project() || session_.open_project().is_read_only()) return;
    const auto pose = *moved_pose_;
    const auto moved = moved_;
    forget_move();
    session_.edit([&](const projects::Project& project) { return move_cameras(project, moved, pose); });
    session_.end_gesture();
}

void ExperimentCamera::bookmark() {
    finish_move();
    const auto now = pose();
    if (!now) return;
    session_.edit([&](const projects::Project& project) {
        return projects::edits::add(project, new_view(project, *now, "Bookmark"));
    });
}

}  // namespace ir::gui
