#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderers/scene/world.h"

namespace ir::passes {

/// What a ray must know to pass through the holes of masked triangles; a copy, so that it may outlive the
/// world.
class AlphaMasks {
  public:
    AlphaMasks(const scene::Scene& scene, const scene::World& world);

    /// Whether masked triangle `triangle` (0 for the world's first one behind the opaque ones) is there at
    /// barycentric coordinates (1 - u - v, u, v).
    bool is_covered(std::uint32_t triangle, float u, float v) const;
    std::uint64_t bytes() const;

  private:
    struct Triangle {
        glm::vec2 uv[3];  ///< after the slot's transform
        std::int32_t bitmap;
        std::int32_t sampler;
    };
    Triangle make_triangle(const scene::Scene& scene, const scene::World& world, std::size_t index) const;

    scene::World bitmaps_;  ///< only opacity and opacity_words
    std::vector<scene::Sampler> samplers_;
    std::vector<Triangle> triangles_;
};

}  // namespace ir::passes
