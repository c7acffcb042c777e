#pragma once

#include "renderers/graph/pass_context.h"
#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/shadow/host_shadow_maps.h"
#include "renderers/passes/surface/surface.h"

namespace ir::methods::deep_screen_space {

/// Surfaces of senders, on the host: sent.glsl, ray_slope_variance of resolve.comp and what
/// resolve_glossy.glsl says of widths. Thread-safe.
class SenderSurfaces {
  public:
    /// For a pass of the cpu queue that reads the surfaces (host_surfaces()).
    SenderSurfaces(const graph::PassContext& context, graph::ObjectRef surfaces,
                   const Parameters& parameters);

    /// A point of a triangle, by the weights of its second and third corner, as a ray of this direction meets
    /// it. `position_ws` asks for light; `lift` (m) raises it from the surface for shadows.
    struct Place {
        passes::Surface surface;
        glm::vec3 position_ws;
        float lift;
    };
    Place place(std::uint32_t triangle, glm::vec2 weights, glm::vec3 position_ws, float radius,
                glm::vec3 direction_ws) const;

    /// Of an irradiance by sources with an extent (W/m²) what is reflected to all sides alike, W/(m² sr).
    glm::vec3 of_extended(const passes::Surface& surface, glm::vec3 irradiance) const;

    bool are_glossy() const { return is_glossy_; }
    /// Widens the highlight by a variance of half vectors' slopes, and gives the factor that keeps its light.
    float widen(passes::Surface& surface, glm::vec3 direction_ws, float variance) const;
    /// As in resolve.comp.
    float ray_slope_variance(std::uint32_t triangle, float distance_m, float density) const;
    float ior(const passes::Surface& surface) const;

  protected:
    glm::vec3 albedo(const passes::Surface& surface) const;
    glm::vec3 below_interface(const passes::Surface& surface, glm::vec3 to_light_ws) const;
    glm::vec3 whole_brdf(const passes::Surface& surface, glm::vec3 l, glm::vec3 v) const;

  private:
    std::shared_ptr<passes::SurfaceLookup> surfaces_;
    const scene::Scene& scene_;
    const scene::World& world_;
    Transport::Materials materials_;
    bool is_glossy_;
    float light_offset_;  ///< radii
    float highlight_share_;
};

/// What senders reflect of direct light, on the host: sent.glsl and resolve_glossy.glsl. Thread-safe.
class HostSenders : public SenderSurfaces {
  public:
    /// For a pass of the cpu queue that reads the surfaces and the shadow maps.
    HostSenders(const graph::PassContext& context, graph::ObjectRef surfaces,
                const passes::ShadowMaps& shadow, const Parameters& parameters);

    /// W/(m² sr), to all sides alike. `extended`: irradiance by sources with an extent, W/m².
    glm::vec3 diffuse(const Place& place, glm::vec3 extended) const;
    /// What is sent to the ray's origin more, or less, of lights without extent; 0 without glossy senders.
    /// `variance`: of the slopes of half vectors along each axis, over which highlights are averaged.
    glm::vec3 glossy_rest(Place place, glm::vec3 direction_ws, float variance) const;
    /// Both together, of lights without extent.
    glm::vec3 all(Place place, glm::vec3 direction_ws, float variance) const;

  private:
    template <class Reflect>
    glm::vec3 sum_of_lights(const Place& place, const Reflect& reflect) const;

    const std::vector<scene::Light>& lights_;
    passes::HostShadowMaps shadows_;
};

}  // namespace ir::methods::deep_screen_space
