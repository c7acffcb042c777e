#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderers/passes/lights/light_bounds.h"

namespace ir::passes {

/// Chooses among many lights by what they may send to a point: a binary tree of groups, descended with
/// probabilities in proportion to each side's importance.  [Conty18]
/// Left out is only what cannot send light to the point, or, where there is a plane, not to its upper side.
class LightTree {
  public:
    struct Choice {
        std::uint32_t light = 0;
        float probability = 0;
    };

    /// One leaf a light, except for those of intensity 0.
    explicit LightTree(const std::vector<LightBounds>& lights);

    bool empty() const { return nodes_.empty(); }

    /// `u` uniform in [0, 1), with bits to spare: each level uses up some. `normal_ws` is the plane's unit
    /// normal or 0. Nothing where no light reaches.
    std::optional<Choice> choose(glm::vec3 position_ws, glm::vec3 normal_ws, double u) const;
    /// With which choose() chooses a light (by its index at construction).
    float probability(glm::vec3 position_ws, glm::vec3 normal_ws, std::uint32_t light) const;

    /// False only where a ray along a unit direction meets none of the lights, nor does one that is moved
    /// aside as far as rays are that start anew at panes.
    bool may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const;

  private:
    static constexpr std::uint32_t none = 0xffffffffu;
    struct Node {
        glm::vec3 centre{0};
        float squared_radius = 0;
        glm::vec3 axis{0};
        float intensity = 0;
        float cos_normals = 0, sin_normals = 0, cos_emission = 0;
        std::uint32_t two_sided = 0;
        std::uint32_t parent = none;
        std::uint32_t right = none;  ///< the left child is the next node; none: a leaf
        std::uint32_t light = none;
    };
    struct Builder;

    float importance(const Node& node, glm::vec3 position_ws, glm::vec3 normal_ws) const;
    /// The first node after a node's subtree, or none.
    std::uint32_t after(std::uint32_t node) const;

    std::vector<Node> nodes_;            ///< the root first
    std::vector<std::uint32_t> leaves_;  ///< per light: its node or none
};

}  // namespace ir::passes
