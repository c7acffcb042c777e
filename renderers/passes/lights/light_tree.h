#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderers/passes/lights/light_bounds.h"
#include "renderers/passes/lights/light_group.h"
#include "shaders/passes/lights/sources.glsl.h"

namespace ir::passes {

/// A point for which lights are chosen, of a plane with this unit normal (or 0), and what a light tree has
/// found out about it: of many samples at one point the first pays for the weights of groups near the root.
struct LightReceiver {
    glm::vec3 position_ws, normal_ws;

    LightReceiver(glm::vec3 position, glm::vec3 normal) : position_ws(position), normal_ws(normal) {}

  private:
    friend class LightTree;
    static constexpr std::uint32_t remembered = 1 + LightGroup::capacity;
    std::uint32_t known_ = 0;  ///< bit i: `weights_[i]` are those of the tree's group i
    std::array<LightWeights, remembered> weights_;
    LightWeights others_;
};

/// Chooses among many lights by what they may send to a point: a tree of groups, descended with probabilities
/// in proportion to each one's importance.  [Conty18], with up to 16 groups in place of two
/// Left out is only what cannot send light to the point, or, where there is a plane, not to its upper side.
class LightTree {
  public:
    struct Choice {
        std::uint32_t light = 0;
        float probability = 0;
    };

    /// One leaf a light, except for those of intensity 0.
    explicit LightTree(const std::vector<LightBounds>& lights);

    bool empty() const { return groups_.empty(); }

    /// `u` uniform in [0, 1), with bits to spare: each level uses up some. Nothing where no light reaches.
    std::optional<Choice> choose(LightReceiver& receiver, double u) const;
    /// With which choose() chooses a light (by its index at construction).
    float probability(LightReceiver& receiver, std::uint32_t light) const;

    /// False only where a ray along a unit direction meets none of the lights, nor does one that is moved
    /// aside as far as rays are that start anew at panes.
    bool may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const;

    /// The same tree for the device: the root first, which is no source itself, children next to each other.
    std::vector<LightNode> flattened() const;

  private:
    static constexpr std::uint32_t none = 0xffffffffu;
    struct Place {
        std::uint32_t group = none;
        int member = 0;
    };
    struct Group : LightGroup {
        Place parent;                                              ///< of the root: none
        std::array<std::uint32_t, capacity> children{}, lights{};  ///< of each member one of them, else none
    };
    struct Builder;

    const LightWeights& weights(LightReceiver& receiver, std::uint32_t group) const;
    bool meets(std::uint32_t group, glm::vec3 origin_ws, glm::vec3 direction_ws) const;

    std::vector<Group> groups_;  ///< level by level from the root on
    std::vector<Place> leaves_;  ///< per light
};

}  // namespace ir::passes
