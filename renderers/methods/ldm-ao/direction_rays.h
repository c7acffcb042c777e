#pragma once

#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::ldm_ao {

/// A pixel's point, off which rays along the maps' directions start.
struct RayStart {
    glm::vec3 origin_ws, geometric_ws, shading_ws;

    RayStart(glm::vec3 position_ws, glm::vec3 geometric_normal_ws, glm::vec3 shading_normal_ws)
        : origin_ws(passes::offset_origin(position_ws, geometric_normal_ws)),
          geometric_ws(geometric_normal_ws),
          shading_ws(shading_normal_ws) {}
};

/// Puts the ray of a map's direction, on the side of the shading normal, into a lane; one that starts below
/// the triangle stays inactive. Returns its cosine with the shading normal.
inline float put_ray(passes::Bvh::Packet16& packet, int lane, const RayStart& x,
                     const passes::ldm::MapFrame& frame, float reach) {
    auto direction = glm::vec3(frame.direction);
    float cosine = glm::dot(x.shading_ws, direction);
    if (cosine < 0) direction = -direction, cosine = -cosine;
    packet.ox[lane] = x.origin_ws.x, packet.oy[lane] = x.origin_ws.y, packet.oz[lane] = x.origin_ws.z;
    packet.dx[lane] = direction.x, packet.dy[lane] = direction.y, packet.dz[lane] = direction.z;
    packet.far[lane] = reach;
    packet.active[lane] = glm::dot(x.geometric_ws, direction) > 0 ? -1 : 0;
    return cosine;
}

}  // namespace ir::methods::ldm_ao
