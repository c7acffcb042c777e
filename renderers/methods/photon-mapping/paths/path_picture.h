#pragma once

#include <cstdint>
#include <span>

#include "renderers/methods/photon-mapping/paths/paths.h"
#include "renderers/scene/view.h"

namespace ir::methods::photon_mapping {

/// Draws legs over a picture: number of the leg + 1 where a line is, the chosen path thickest and last,
/// dotted behind what is seen. `surfaces`: world space, w = 0 where nothing is seen; of the view, as `marks`.
void draw_legs(std::span<const PathLeg> legs, const scene::View& view, std::span<const glm::vec4> surfaces,
               std::span<std::uint32_t> marks);

}  // namespace ir::methods::photon_mapping
