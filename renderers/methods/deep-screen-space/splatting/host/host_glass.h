#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/sampling/pcg.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/passes/surface/triangle_plane.h"
#include "renderers/scene/world.h"

namespace ir::methods::deep_screen_space {

/// Part of a material that is glass through which rays go, as open_glass of glass.glsl.
inline float open_glass(const scene::Material& m) {
    const bool is_open = !m.unlit && m.transmission_texture.texture < 0 && m.emission == glm::vec3(0);
    return is_open ? m.transmission * (1 - m.metallic) : 0;
}

/// glass.glsl on the host, where rays meet triangles and discs. Thread-safe.
class HostGlass {
  public:
    HostGlass(const scene::Scene& scene, const scene::World& world) : world_(world) {
        for (const auto& m : scene.materials)
            glasses_.push_back(
                {open_glass(m) * passes::luminance(glm::vec3(m.base_colour)), m.ior, m.thickness <= 0});
    }

    bool is_open_glass(std::uint32_t triangle) const { return glass(triangle).part > 0; }

    /// `slope`: of the direction along the normal by the triangle's winding.
    float passed_by_glass(std::uint32_t triangle, float slope) const {
        const auto& g = glass(triangle);
        if (g.part == 0) return 0;
        const float of_interface =
            passes::dielectric_fresnel(std::clamp(std::abs(slope), 1e-4f, 1.0f), g.ior).reflectance;
        return g.part * (1 - (g.is_sheet ? passes::sheet_reflectance(of_interface) : of_interface));
    }
    bool passes_glass(std::uint32_t triangle, float slope, glm::vec3 direction_ws) const {
        const float part = passed_by_glass(triangle, slope);
        if (part == 0) return false;
        const auto side = 2 * world_.triangle_materials[triangle] + (slope > 0 ? 1u : 0u);
        const auto bits = [](float f) { return std::bit_cast<std::uint32_t>(f); };
        return passes::unit_float(
                   passes::pcg4d({bits(direction_ws.x), bits(direction_ws.y), bits(direction_ws.z), side})
                       .w) < part;
    }
    float slope(std::uint32_t triangle, glm::vec3 direction_ws) const {
        return glm::dot(passes::triangle_normal(world_, triangle), direction_ws);
    }

    /// The first hit that `is_passed` does not say of that the ray goes on behind it; the one behind
    /// max_panes ends it.
    template <class IsPassed>
    static passes::Hit first_hit(const passes::Bvh& bvh, glm::vec3 origin, glm::vec3 direction, float far,
                                 const IsPassed& is_passed) {
        auto hit = bvh.closest_hit(origin, direction, 0, far);
        for (int pane = 0; pane < passes::max_panes && hit.is_hit() && is_passed(hit.triangle); ++pane) {
            const float from = hit.distance + passes::ray_offset(origin + hit.distance * direction);
            hit = bvh.closest_hit(origin, direction, from, far);
        }
        return hit;
    }

  private:
    struct Glass {
        float part, ior;
        bool is_sheet;
    };
    const Glass& glass(std::uint32_t triangle) const { return glasses_[world_.triangle_materials[triangle]]; }

    const scene::World& world_;
    std::vector<Glass> glasses_;  ///< of the materials
};

}  // namespace ir::methods::deep_screen_space
