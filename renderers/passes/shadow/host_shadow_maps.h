#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "shaders/lib/light.glsl.h"

namespace ir::passes {

/// Shadow maps on the host, by the rules of shaders/passes/shadow/shadow.glsl. Thread-safe.
class HostShadowMaps {
  public:
    /// For a pass of the cpu queue that reads maps and panes.
    HostShadowMaps(const graph::PassContext& context, const ShadowMaps& shadow);

    /// As shadow_visibility of one texel. `normal_ws` is the geometric normal, turned to the light;
    /// `light` an index into World::lights, of unit direction `to_light_ws`.
    glm::vec3 visibility(std::size_t light, glm::vec3 position_ws, glm::vec3 normal_ws,
                         glm::vec3 to_light_ws) const;

  private:
    glm::vec3 passed_panes(std::size_t layer, glm::vec2 place) const;
    int layer_of(const LightData& light, glm::vec3 position_ws) const;

    std::vector<LightData> lights_;
    std::vector<std::span<const float>> layers_;
    std::vector<std::span<const std::uint64_t>> panes_;
    int resolution_, pane_resolution_;
    std::vector<ShadowViewData> views_;
};

}  // namespace ir::passes
