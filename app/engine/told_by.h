#pragma once

#include <map>
#include <string>

#include "projects/json.h"
#include "renderers/image/exr.h"

namespace ir::engine {

/// All that a file says of its picture, by place: "set.directions", "camera.eye", and of the recipe scenes,
/// lights and motions ("lights/0/lights/0/intensity"). Empty where nothing tells how it was rendered. `file`
/// is for messages. Throws InputError.
std::map<std::string, projects::Json> told_by(const ImageAttributes& attributes, const std::string& file);

}  // namespace ir::engine
