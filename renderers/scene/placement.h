#pragma once

#include <glm/glm.hpp>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// A camera that looks along -Z of a space that `world_from_node` places, up along its +Y.
Camera placed(Camera camera, const glm::mat4& world_from_node);

/// A light of a node, in world space; its intensity does not scale with the node [KHR_lights_punctual].
Light placed(Light light, const glm::mat4& world_from_node);

}  // namespace ir::scene
