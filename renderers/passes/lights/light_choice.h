#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderers/passes/lights/light_tree.h"
#include "renderers/passes/lights/triangle_lights.h"
#include "renderers/scene/scene.h"

namespace ir::passes {

/// Which of a scene's emitters a sample is spent on. Emitters are numbered: the lights of the world, then the
/// emissive triangles. Between what is infinitely far (directional lights, environment) and the rest it
/// decides by their power, among the rest by a light tree.
class LightChoice {
  public:
    struct Chosen {
        int emitter = 0;  ///< or `environment`
        float probability = 0;
    };
    static constexpr int environment = -1;

    /// `triangles` may be null. `environment_luminance` averaged over the sphere, W/(m² sr).
    LightChoice(const std::vector<scene::Light>& lights, const TriangleLights* triangles,
                float environment_luminance, float scene_radius);

    bool empty() const;
    /// Lights wholly below the receiver's plane are left out.
    std::optional<Chosen> choose(LightReceiver& receiver, double u) const;
    float probability(LightReceiver& receiver, int emitter) const;
    float environment_probability(glm::vec3 normal_ws) const;
    /// LightTree::may_meet() of what has a place.
    bool may_meet(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
        return tree_.may_meet(origin_ws, direction_ws);
    }
    const LightTree& tree() const { return tree_; }
    float tree_weight() const { return tree_weight_; }
    float environment_weight() const { return environment_weight_; }

  private:
    struct Sun {
        int light = 0;
        glm::vec3 to_light{0};
        float weight = 0;
    };
    static float weight_of(const Sun& sun, glm::vec3 normal_ws);
    float total(glm::vec3 normal_ws) const;

    LightTree tree_;
    std::vector<Sun> suns_;
    float tree_weight_ = 0, environment_weight_ = 0;
};

}  // namespace ir::passes
