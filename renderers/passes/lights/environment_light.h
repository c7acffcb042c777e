#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderers/passes/lights/discrete_distribution.h"
#include "renderers/scene/scene.h"

namespace ir::passes {

/// Light from infinity: the constant, or, where there is one, the map, bilinear between its texels' centres.
/// Negative and non-finite values count as 0.
class EnvironmentLight {
  public:
    struct Sample {
        glm::vec3 direction_ws{0};
        glm::vec3 radiance{0};
        float pdf = 0;  ///< per solid angle
    };

    explicit EnvironmentLight(const scene::Environment& environment);

    bool is_constant() const { return !map_; }
    bool empty() const { return !(mean_luminance_ > 0); }  ///< black everywhere
    /// Averaged over the sphere, W/(m² sr).
    float mean_luminance() const { return mean_luminance_; }
    glm::vec3 radiance(glm::vec3 direction_ws) const;

    /// A direction by u in [0, 1)². Constant: by the cosine to the unit normal, or, where that is 0,
    /// uniformly on the sphere. Map: each texel by its light, uniformly within in solid angle.
    Sample sample(glm::vec3 normal_ws, glm::vec2 u) const;
    /// Density per solid angle with which sample() chooses the direction; above 0 wherever the map shines.
    float pdf(glm::vec3 normal_ws, glm::vec3 direction_ws) const;

    /// A map's texels and distribution as shaders/passes/lights/environment_light.glsl reads them; empty
    /// without a map.
    struct Tables {
        int width = 0, height = 0;
        std::vector<glm::vec4> texels;
        std::vector<float> columns;  ///< of each row the sums after its texels
        std::vector<float> rows;
    };
    Tables tables() const;

  private:
    glm::vec3 texel(int x, int y) const;
    void build_distribution();
    float texel_pdf(int x, int y) const;
    double height_of(std::size_t row) const { return cos_edges_[row] - cos_edges_[row + 1]; }

    glm::vec3 constant_{0};
    std::shared_ptr<const Image> map_;  ///< none: the constant
    float mean_luminance_ = 0;
    std::vector<double> cos_edges_;  ///< cosines to +Y of the rows' upper edges, and of the last one's lower
    DiscreteDistribution rows_;
    std::vector<DiscreteDistribution> columns_;  ///< of each row
};

}  // namespace ir::passes
