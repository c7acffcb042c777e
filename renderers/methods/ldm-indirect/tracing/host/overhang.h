#pragma once

#include "renderers/methods/ldm-indirect/splatting/host/kernels.h"
#include "renderers/passes/ldm/host/first_hit.h"
#include "shaders/methods/ldm-indirect/tracing/overhang.glsl.h"

namespace ir::methods::ldm_indirect {

/// In 1/64, what of a kernel lies beyond its surface, by the entries of the map; as tracing/overhang.glsl
/// finds it. What other bands of the map know is left out.
std::uint32_t part_beyond(const passes::ldm::PointTracer& map, const passes::ldm::MapFrame& frame,
                          const Photon& photon, const HostEllipse& ellipse);

}  // namespace ir::methods::ldm_indirect
