#pragma once

#include <functional>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/parameters.h"
#include "renderers/passes/ldm/builder.h"
#include "renderers/passes/raytracing/bvh.h"

namespace ir::methods::ldm_indirect {

/// m: maps do not see what lies nearer to a surface: less than some texels.
float narrow_gap(const passes::ldm::Maps& maps);
/// m: rays start so far from their surface, because images of lights know places to rounding only.
float ray_start(const passes::ldm::Maps& maps);

/// First hits of rays on the host: by Embree, or in a layered depth cube if the parameter `tracer` says so.
class FirstHits {
  public:
    FirstHits(graph::GraphBuilder& builder, const passes::ldm::Maps& maps, const Parameters& parameters);
    void read_by(graph::PassBuilder& pass) const { pass.reads(scene_); }

    /// Of the ray that leaves a place on a surface with this geometric normal; distances are from there.
    using Find = std::function<passes::Hit(const glm::vec3& position_ws, const glm::vec3& normal_ws,
                                           const glm::vec3& direction)>;
    /// Within a pass that reads it. Thread-safe.
    Find in(const graph::PassContext& context) const;

  private:
    graph::ObjectRef scene_;
    bool has_cube_;
    float start_;
};

}  // namespace ir::methods::ldm_indirect
