#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "renderers/passes/raytracing/bvh.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// A point on a triangle as light transport on the host sees it: the same quantities as the G-buffer's, from
/// textures at their finest level, bilinear where their sampler says linear.
struct Surface {
    glm::vec3 position_ws{0};
    glm::vec3 geometric_normal_ws{0};  ///< unit, on the side that the ray came from
    glm::vec3 shading_normal_ws{0};    ///< unit, turned as the G-buffer turns it
    bool is_front = true;              ///< the ray came from the side to which the winding's normal points
    int material = 0;                  ///< of Scene::materials
    glm::vec3 base_colour{1};
    float metallic = 0, roughness = 1, transmission = 0;
    glm::vec3 emission{0};  ///< W/(m² sr), the same on both sides
    bool is_unlit = false;
};

/// How far the point that a pixel shows moves on its plane to the next column and to the next row, m.
struct Footprint {
    glm::vec3 by_column_ws{0}, by_row_ws{0};
};

class HostTexture;

/// Looks surfaces up on the host. Thread-safe.
class SurfaceLookup {
  public:
    /// Without `reflectance` textures of metallic, roughness and transmission are not queried, for models
    /// that do not use them: texels that are not in the cache cost as much as a ray.
    SurfaceLookup(const scene::Scene& scene, const scene::World& world, bool normal_maps,
                  bool reflectance = true);
    /// With mip maps: textures with all levels, as many as the scene's. Only scene() and world() then need
    /// these any longer.
    using Textures = std::shared_ptr<const std::vector<HostTexture>>;
    SurfaceLookup(const scene::Scene& scene, const scene::World& world, bool normal_maps, Textures textures,
                  bool reflectance = true);
    ~SurfaceLookup();
    SurfaceLookup(const SurfaceLookup&) = delete;

    /// Where they still exist.
    const scene::Scene& scene() const;
    const scene::World& world() const;
    std::uint64_t bytes() const;  ///< of what it holds itself, a copy of the triangles
    std::span<const scene::Material> materials() const;
    const scene::Material& material(int index) const { return materials()[static_cast<std::size_t>(index)]; }

    /// What a ray with this (unit) direction of travel hits.
    Surface at(const Hit& hit, glm::vec3 direction_ws) const;
    /// The same, filtered over a pixel.
    Surface at(const Hit& hit, glm::vec3 direction_ws, const Footprint& footprint) const;
    /// Whether shape() and reflectance() look at the footprint.
    bool has_normal_map(std::uint32_t triangle) const;
    bool has_textures(std::uint32_t triangle) const;
    /// Only place, side and normals, where the plane's normal is known.
    Surface shape(const Hit& hit, glm::vec3 direction_ws, const Footprint& footprint,
                  glm::vec3 plane_normal) const;
    /// Only what the material says.
    Surface reflectance(const Hit& hit, const Footprint& footprint) const;
    /// Normal of a triangle's plane, by its winding, and a corner.
    std::pair<glm::vec3, glm::vec3> plane(std::uint32_t triangle) const;
    /// Only the emission there; cheap.
    glm::vec3 emission(std::uint32_t triangle, float u, float v) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace ir::passes
