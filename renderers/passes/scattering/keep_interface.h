#pragma once

#include <glm/glm.hpp>

#include "renderers/core/transport.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// Leaves the interface alone of a surface, which no Lambert surface has: a metal of its reflectance. Returns
/// which part of the surface that is.
inline float keep_interface(Surface& surface, float ior, Transport::Materials model) {
    const float opaque = 1 - surface.transmission * (1 - surface.metallic);
    const float part = model == Transport::Materials::metalness_blend ? opaque * surface.metallic : opaque;
    if (model == Transport::Materials::gltf)
        surface.base_colour = layered_f0(ior, surface.base_colour, surface.metallic);
    surface.metallic = 1;
    surface.transmission = 0;
    return part;
}

}  // namespace ir::passes
