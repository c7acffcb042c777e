#pragma once

#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/methods/deep-screen-space/surfels/source_irradiance.h"

namespace ir::methods::deep_screen_space {

/// Weights of the second and third corner of a triangle at a point in its plane, clamped to it.
glm::vec2 weights_at(const scene::World& world, std::uint32_t triangle, const glm::vec3& position_ws);

/// Irradiance by sources with an extent where rays of level 0 met triangles. Thread-safe.
class Level0Light {
  public:
    /// Objects of the frame's BVH and sources, which the pass reads.
    Level0Light(const graph::PassContext& context, graph::ObjectRef bvh, graph::ObjectRef sources,
                const Parameters& parameters)
        : bvh_(context.object<passes::Bvh>(bvh)),
          sources_(context.object<passes::ExtendedEmitters>(sources)),
          estimate_(*bvh_, *sources_, parameters),
          seed_(random_seed(context.inputs(), parameters)) {}

    /// W/m². `ray`: the number of the ray among all.
    glm::vec3 irradiance(std::uint32_t triangle, glm::vec2 weights, glm::vec3 direction_ws,
                         std::uint64_t ray) const {
        const auto surface = sources_->surfaces.at(
            {.distance = 0, .triangle = triangle, .u = weights.x, .v = weights.y}, direction_ws);
        const auto key = passes::mixed(seed_ ^ ray ^ exact_hit);
        return estimate_.irradiance(surface, surface.geometric_normal_ws, key, 1);
    }

  private:
    std::shared_ptr<passes::Bvh> bvh_;
    std::shared_ptr<passes::ExtendedEmitters> sources_;
    SourceIrradiance estimate_;
    std::uint64_t seed_;
};

/// Declares the pass "light samples of level 0", for the device.
void light_level0(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch);

}  // namespace ir::methods::deep_screen_space
