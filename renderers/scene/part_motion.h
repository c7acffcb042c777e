#pragma once

#include <string>
#include <vector>

#include "renderers/scene/compose.h"

namespace ir::scene {

/// Throws UsageError for keys that are not finite or do not ascend; `source` is the part's.
void check_motion(const PartMotion& motion, const std::string& source);

/// The keys as an animation of a node; empty without keys.
std::vector<AnimationChannel> channels_of(const PartMotion& motion, int node);

/// A node at which placed() gives the camera back.
Node node_of(const Camera& camera);

}  // namespace ir::scene
