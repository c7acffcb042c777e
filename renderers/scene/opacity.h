#pragma once

#include "renderers/scene/world.h"

namespace ir::scene {

/// Fills World::opacity and opacity_words: texture alpha times factor at or above the cut-off. A material
/// without a base colour texture gets a single texel. Vertex colours' alpha does not count.
void build_opacity(const Scene& scene, World& world);

}  // namespace ir::scene
