#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "projects/document.h"

namespace ir::projects {

std::string to_string(Motion::Kind kind);  ///< "camera", "light", "part"

/// The values at `time` (seconds); the motion has keys.
Motion::Key key_at(const Motion& motion, double time);

/// Whether it is not the same at all times.
bool is_moving(const Motion& motion);

/// The motion that counts; null where nothing with keys moves it.
const Motion* motion_of_camera(const Project& project, const std::string& camera);
const Motion* motion_of_light(const Project& project, const std::string& lights, int light);
const Motion* motion_of_light(const Project& project, const std::string& lights, const std::string& name);
const Motion* motion_of_part(const Project& project, const std::string& scene, int part);

/// All that count for an experiment as it runs: its camera's, its lights', its scene's parts'.
std::vector<const Motion*> motions_of(const Project& project, const Experiment& experiment);

/// Seconds: the last key of those that move; 0: none does. What the scene's files animate does not count.
double moves_until(const Project& project, const Experiment& experiment);

/// The camera with its motion applied at `time` (seconds). Cameras of the scene's file come back as they are.
Camera camera_at(const Project& project, const Camera& camera, double time);
/// The light as a key says; what the key does not say stays.
LightSpec light_at(const LightSpec& light, const Motion::Key& key);
/// Rz Ry Rx of angles in degrees.
glm::dquat rotation_of(const glm::dvec3& degrees);
/// T R S of a part, column-major.
std::array<double, 16> transform_of(const Motion::Key& key);
/// The key at which a part stands where `transform` puts it. Shear is lost.
Motion::Key key_of(const std::array<double, 16>& transform);

}  // namespace ir::projects
