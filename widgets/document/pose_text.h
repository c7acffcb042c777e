#pragma once

#include <string>
#include <string_view>

#include "widgets/image/camera_motion.h"

namespace ir::widgets {

/// "x,y,z x,y,z x,y,z FOV": eye, target, up in metres, vertical field of view in degrees; orthographic
/// cameras end in "HEIGHTm" instead. Every digit is kept.
std::string pose_text(const CameraPose& pose);

/// The pose of such a text, of which up and field of view may be missing: then `present` gives them. Also
/// takes the words of the command line ("--eye x,y,z --target …"). Throws UsageError with what is wrong.
CameraPose parse_pose(std::string_view text, const CameraPose& present);

}  // namespace ir::widgets
