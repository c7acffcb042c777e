#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "renderers/graph/builder.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// A ray-tracing scene over a World: the oracle that every approximate visibility is judged by. Alpha masks
/// are asked through scene::is_covered, as in rasterisation. Thread-safe for queries.
class Bvh {
  public:
    /// `threads` 0 = all. Keeps a reference to the world.
    Bvh(const scene::Scene& scene, const scene::World& world, int threads = 0);
    ~Bvh();
    Bvh(const Bvh&) = delete;

    /// Distance to the first hit along a unit direction within (near, far), or infinity.
    float closest(glm::vec3 origin, glm::vec3 direction, float near, float far) const;
    bool occluded(glm::vec3 origin, glm::vec3 direction, float near, float far) const;
    /// Sixteen rays at once; bit i of the result is set when ray i is blocked. `coherent` helps packets with
    /// similar rays.
    struct Packet16 {
        alignas(64) float ox[16], oy[16], oz[16], dx[16], dy[16], dz[16], near[16], far[16];
        alignas(64) int active[16];  ///< -1 or 0
    };
    unsigned occluded16(const Packet16& rays, bool coherent) const;
    std::uint64_t bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Declares the pass "BVH" (cpu), kept while the world stays the same.
graph::ObjectRef bvh(graph::GraphBuilder& builder);

}  // namespace ir::passes
