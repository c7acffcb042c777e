#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/core/record.h"

namespace ir::methods::deep_screen_space {

/// A disc that stands for a piece of the scene's surface. 64 bytes; equals struct Surfel of
/// shaders/methods/deep-screen-space/records.glsl; seen as a glyph it is its disc.
struct Surfel {
    glm::vec3 centre_ws;
    std::uint32_t triangle;  ///< of World::indices
    glm::vec3 normal_ws;     ///< unit, of the triangle's plane, by its winding
    float radius;            ///< m: π radius² is the area that the surfel stands for
    glm::vec3
        radiance_front;  ///< W/(m² sr), on the normal's side: diffuse part of direct light, and emission
    std::uint32_t barycentrics;  ///< weights of the triangle's second and third corner, 2 x 16 bits UNORM
    glm::vec3 radiance_back;     ///< on the other side
    std::uint32_t identity;  ///< hash of triangle and place: what random choices about the surfel are made
                             ///< of, the same whatever else is culled
    IR_FIELDS(centre_ws, triangle, normal_ws, radius, radiance_front, barycentrics, radiance_back, identity)
};

/// What the device reads of an indirect draw.
struct DrawCommand {
    std::uint32_t vertices, instances, first_vertex, base_instance;
    IR_FIELDS(vertices, instances, first_vertex, base_instance)
};

}  // namespace ir::methods::deep_screen_space
