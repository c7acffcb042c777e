#pragma once

#include <string>

#include "renderers/core/record.h"
#include "renderers/graph/builder.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::passes {

/// What finds the first hits of rays that are in a buffer.
enum class Tracer { compute, embree };

/// 32 bytes; `far` <= 0: no ray. Unit directions. Equals struct Ray of shaders/passes/raytracing/rays.glsl.
struct RayRecord {
    glm::vec3 origin_ws;
    float far;
    glm::vec3 direction_ws;
    float unused;
    IR_FIELDS(origin_ws, far, direction_ws, unused)
};
/// 16 bytes; distance infinite: nothing is hit. Equals struct RayHit of rays.glsl.
struct RayHitRecord {
    float distance;
    std::uint32_t triangle;  ///< of World::indices
    float u, v;              ///< barycentric weights of the triangle's second and third corner
    IR_FIELDS(distance, triangle, u, v)
};

/// "KEY.rays" and "KEY.hits" with room for `rays`.
struct RayBuffers {
    graph::BufferRef rays, hits;
    std::uint64_t capacity = 0;
};
RayBuffers declare_rays(graph::GraphBuilder& builder, const std::string& key, std::uint64_t rays);

/// Declares the pass NAME: the first hit of each ray of the buffer, alpha masks respected. `compute` walks a
/// BVH on the device ("scene.bvh", built on the host once per world), `embree` asks the oracle on the host.
void trace_rays(graph::GraphBuilder& builder, const std::string& name, const SceneBuffers& scene,
                Tracer tracer, const RayBuffers& buffers);

}  // namespace ir::passes
