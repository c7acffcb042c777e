#pragma once

#include "renderers/methods/deep-screen-space/surfels/packing.h"
#include "renderers/methods/deep-screen-space/surfels/patches.h"

namespace ir::methods::deep_screen_space {

/// A surfel before thinning: 48 bytes, as transform feedback writes it.
struct FineSurfel {
    glm::vec3 centre_ws;
    std::uint32_t triangle;
    glm::vec3 normal_ws;
    float radius;                          ///< m: π radius² is the patch's area over its number of surfels
    std::uint32_t barycentrics, identity;  ///< as of Surfel
    std::uint32_t patch;                   ///< index in "surfels.patches.list"
    float part;                            ///< of the ideal area at its place
    IR_FIELDS(centre_ws, triangle, normal_ws, radius, barycentrics, identity, patch, part)
};

/// Declares "surfels.fine", without what fills it: patches count what goes into it.
Growing declare_fine(graph::GraphBuilder& builder, std::uint64_t reserve);

/// Declares the pass that fills it, by hardware tessellation. [Nalbach15 fig. 6 b]
void tessellate(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const Patches& patches,
                const Growing& fine, const Parameters& parameters);

}  // namespace ir::methods::deep_screen_space
