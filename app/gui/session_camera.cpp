#include <algorithm>

#include "app/gui/session.h"

namespace ir::gui {
namespace {

widgets::CameraPose pose_of(const projects::Camera& camera) {
    return {camera.eye, camera.target, camera.up, camera.fov_y_degrees, camera.orthographic, camera.height};
}

widgets::CameraPose pose_of(const scene::Camera& camera) {
    return {camera.eye,          camera.target, camera.up, glm::degrees(double(camera.fov_y)),
            camera.orthographic, camera.height};
}

projects::Camera posed(projects::Camera camera, const widgets::CameraPose& pose) {
    camera.scene_camera.clear();
    camera.eye = pose.eye;
    camera.target = pose.target;
    camera.up = pose.up;
    camera.fov_y_degrees = pose.fov_y_degrees;
    camera.orthographic = pose.orthographic;
    camera.height = pose.height;
    return camera;
}

/// Whether the pose can be changed in place: a pose of its own that no motion overrides.
bool is_movable(const projects::Project& project, const projects::Camera* camera) {
    return camera && camera->scene_camera.empty() &&
           std::none_of(project.motion.begin(), project.motion.end(),
                        [&](const auto& motion) { return motion.camera == camera->id; });
}

/// Adds a camera with the pose and makes the experiment use it, as one step.
projects::EditPtr add_view(const projects::Project& project, const std::string& experiment,
                           const widgets::CameraPose& pose) {
    projects::Camera camera = posed({}, pose);
    camera.id = projects::free_id_in(project.cameras, "view");
    const auto number = camera.id.find_last_not_of("0123456789") + 1;
    camera.name = number < camera.id.size() ? "View " + camera.id.substr(number) : "View";
    std::vector<projects::EditPtr> steps;
    steps.push_back(projects::edits::add(project, camera));
    projects::Project after = project;
    steps.back()->apply(after);
    steps.push_back(projects::edits::set_camera_of(after, experiment, camera.id));
    return projects::edits::group("Move camera", std::move(steps));
}

}  // namespace

std::optional<widgets::CameraPose> Session::camera_pose() const {
    if (moved_pose_) return moved_pose_;
    const auto* chosen = experiment();
    if (!chosen) return {};
    const auto* camera = projects::find_item(document().cameras, chosen->camera);
    if (camera && camera->scene_camera.empty())
        return pose_of(projects::camera_at(document(), *camera, chosen->time));
    if (!scene_ || scene_->camera_values.empty()) return {};
    if (camera)
        for (std::size_t i = 0; i < scene_->camera_values.size(); ++i)
            if (scene_->camera_values[i].name == camera->scene_camera)
                return pose_of(scene_->camera_values[i]);
    return pose_of(scene_->camera_values.front());
}

void Session::move_camera(const widgets::CameraPose& pose) {
    if (!experiment()) return;
    moved_pose_ = pose;
    update_request();
}

void Session::finish_camera_move() {
    const auto* chosen = experiment();
    // Read-only: one may look around, nothing is written.
    if (!moved_pose_ || !chosen || project_->is_read_only()) return;
    const auto pose = *moved_pose_;
    const std::string id = chosen->id;
    moved_pose_.reset();
    edit([&](const projects::Project& project) {
        const auto* camera =
            projects::find_item(project.cameras, projects::find_item(project.experiments, id)->camera);
        return is_movable(project, camera) ? projects::edits::change_camera(project, posed(*camera, pose))
                                           : add_view(project, id, pose);
    });
    end_gesture();
}

}  // namespace ir::gui
