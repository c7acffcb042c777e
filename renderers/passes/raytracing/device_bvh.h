#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/core/fields.h"
#include "renderers/graph/builder.h"
#include "renderers/scene/world.h"
#include "shaders/passes/raytracing/bvh.glsl.h"

namespace ir::passes {

constexpr std::uint32_t bvh_no_child = bvh_leaf;
constexpr std::uint32_t bvh_leaf_size = 4;
constexpr std::uint64_t bvh_max_triangles = 1u << 28;

/// 64 bytes: both children with their bounds, so that a ray loads one line of a cache to choose.
struct BvhNode {
    glm::vec3 left_min_ws;
    std::uint32_t left;
    glm::vec3 left_max_ws;
    std::uint32_t right;
    glm::vec3 right_min_ws;
    std::uint32_t depth;  ///< 0: root, which is node 0
    glm::vec3 right_max_ws;
    std::uint32_t parent;
    IR_FIELDS(left_min_ws, left, left_max_ws, right, right_min_ws, depth, right_max_ws, parent)
};

/// 48 bytes, in the order of the leaves: no index has to be followed to reach the corners.
struct BvhTriangle {
    glm::vec3 a_ws;
    std::uint32_t triangle;  ///< of World::indices
    glm::vec3 b_ws;
    std::uint32_t mask;  ///< 1 + index into the masks; 0: opaque
    glm::vec3 c_ws;
    std::uint32_t unused;
    IR_FIELDS(a_ws, triangle, b_ws, mask, c_ws, unused)
};

/// 32 bytes: where a masked triangle looks up its alpha mask.
struct BvhMask {
    std::array<glm::vec2, 3> uv;  ///< of the base colour, after its transform
    std::uint32_t material;
    std::uint32_t unused;
    IR_FIELDS(uv, material, unused)
};

/// A binary BVH over a world's triangles, and what it says on paper.
struct DeviceBvhData {
    std::vector<BvhNode> nodes;  ///< depth first; never empty
    std::vector<BvhTriangle> triangles;
    std::vector<BvhMask> masks;
    int depth = 0;             ///< inner nodes on the longest way from the root
    std::size_t left_out = 0;  ///< triangles whose corners are not finite, or beyond 1e18 m
};

/// Built by Embree's builder with the surface area heuristic, `threads` threads (0: all); the same bits for
/// any number of them. Throws Error where Embree fails, e.g. for want of memory, and beyond 2^28 triangles.
DeviceBvhData build_device_bvh(const scene::Scene& scene, const scene::World& world, int threads = 0);

struct DeviceBvh {
    graph::BufferRef nodes, triangles, masks;  ///< "scene.bvh", "scene.bvh.triangles", "scene.bvh.masks"
};

/// Declares the pass "device BVH" (cpu), kept while the world stays the same; what it has declared where it
/// is called again.
DeviceBvh device_bvh(graph::GraphBuilder& builder);

}  // namespace ir::passes
