#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderers/passes/raytracing/alpha_masks.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// The triangles of a world that send light, from both sides, each chosen points uniformly in area.
class TriangleLights {
  public:
    struct Triangle {
        glm::vec3 corner{0}, edge_u{0}, edge_v{0};
        std::uint32_t index = 0;  ///< of the world
        float area = 0;           ///< m²
        float radiance = 0;       ///< luminance, mean over the area, W/(m² sr)
        glm::vec3 cross{0};       ///< edge_u × edge_v: the normal, twice as long as the area
        bool is_even = false;     ///< without texture and mask: sends `emission` everywhere
        glm::vec3 emission{0};    ///< W/(m² sr)
    };
    struct Point {
        glm::vec3 direction_ws{0};
        float distance = 0;
        glm::vec3 radiance{0};
        float pdf = 0;  ///< per solid angle
    };

    /// All triangles with an area whose material's emission factor is not 0. Textures are averaged over each
    /// triangle; where that average is (almost) 0, a small one keeps the triangle in.
    explicit TriangleLights(const SurfaceLookup& surfaces);

    std::size_t size() const { return triangles_.size(); }
    const Triangle& operator[](std::size_t i) const { return triangles_[i]; }
    /// Which of them a triangle of the world is, or -1.
    int find(std::uint32_t world_triangle) const {
        return world_triangle < numbers_.size() ? numbers_[world_triangle] : -1;
    }

    /// A point on triangle i by u in [0, 1)², uniformly in area; nothing where no light is sent: in the holes
    /// of alpha masks and dark texels.
    struct Origin {
        glm::vec3 position_ws{0};
        glm::vec2 barycentric{0};
        glm::vec3 radiance{0};
    };
    std::optional<Origin> origin(std::size_t i, glm::vec2 u) const;
    /// The same as it is seen from a point; nothing edge-on and where no light is sent.
    std::optional<Point> sample(std::size_t i, glm::vec3 position_ws, glm::vec2 u) const;
    /// Density per solid angle with which sample() chooses the point with these barycentric coordinates.
    float pdf(std::size_t i, glm::vec3 position_ws, float u, float v) const;

  private:
    const SurfaceLookup* surfaces_;
    std::vector<Triangle> triangles_;
    std::vector<int> numbers_;  ///< per triangle of the world; empty when none sends light
    std::optional<AlphaMasks> masks_;
    std::uint32_t opaque_triangles_ = 0;
};

}  // namespace ir::passes
