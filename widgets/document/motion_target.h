#pragma once

#include <QString>
#include <vector>

#include "projects/motion.h"
#include "widgets/parameters/option.h"

namespace ir::widgets {

/// Everything of a project that can move, by "camera:ID", "light:SET:INDEX" and "part:SCENE:INDEX"; cameras
/// of a scene's file cannot.
std::vector<Option> motion_targets(const projects::Project& project);

/// What a motion moves, as motion_targets() calls it, and for people.
QString target_id(const projects::Motion& motion);
QString target_name(const projects::Project& project, const projects::Motion& motion);

/// Another thing in the place of the one that moves. Of another kind it gets one key, where it stands now.
/// Throws UsageError where there is no such thing.
void set_target(projects::Motion& motion, const QString& id, const projects::Project& project);

/// The key at which the thing stands without its motion; the thing is in the project.
projects::Motion::Key key_at_rest(const projects::Motion& motion, const projects::Project& project);

}  // namespace ir::widgets
