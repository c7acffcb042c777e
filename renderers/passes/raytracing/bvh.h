#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>

#include "renderers/graph/builder.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// Where a ray meets a triangle of the world.
struct Hit {
    float distance = std::numeric_limits<float>::infinity();  ///< infinity: nothing is hit
    std::uint32_t triangle = 0;                               ///< of World::indices
    float u = 0, v = 0;  ///< barycentric weights of the triangle's second and third corner
    bool is_hit() const { return distance < std::numeric_limits<float>::infinity(); }
};

/// A ray-tracing scene over a World: the oracle that every approximate visibility is judged by. Alpha masks
/// are queried through scene::is_covered, as in rasterisation. Thread-safe for queries.
class Bvh {
  public:
    /// How rays are tested against triangles.
    enum class Edges {
        watertight,  ///< none slips between two triangles that share an edge (exactly at a corner, 0.3 % may)
        fast         ///< of rays exactly at an edge 5 % do; 15 % less time. For benchmarks.
    };

    /// Builds with `threads` threads, 0 = all. Everything that queries need is copied from the world. Throws
    /// Error when Embree fails, e.g. for want of memory.
    Bvh(const scene::Scene& scene, const scene::World& world, int threads = 0,
        Edges edges = Edges::watertight);
    ~Bvh();
    Bvh(const Bvh&) = delete;
    Bvh& operator=(const Bvh&) = delete;

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
    /// Distances to the first hits, infinity where there is none and for inactive rays.
    void closest16(const Packet16& rays, bool coherent, float (&distances)[16]) const;
    /// The first hit itself.
    Hit closest_hit(glm::vec3 origin, glm::vec3 direction, float near, float far) const;
    /// Sixteen of them; what inactive rays get is a Hit that is none. Without `coherent` each is bit for bit
    /// what closest_hit gives, whatever its neighbours (10⁶ random rays of Sponza); with it, of triangles
    /// that lie in one another (0.8 % of those rays) another one may be named.
    void closest_hits16(const Packet16& rays, bool coherent, Hit (&hits)[16]) const;
    /// What Embree holds now, with the alpha masks.
    std::uint64_t bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Declares the pass "BVH" (cpu), kept while the world stays the same. Who asks again in a frame gets the
/// same.
graph::ObjectRef bvh(graph::GraphBuilder& builder);

}  // namespace ir::passes
