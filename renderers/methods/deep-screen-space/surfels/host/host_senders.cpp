#include "renderers/methods/deep-screen-space/surfels/host/host_senders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/reflection/reflection.h"
#include "renderers/passes/scattering/highlights.h"
#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::deep_screen_space {
namespace {

using Materials = Transport::Materials;

constexpr float one_over_pi = std::numbers::inv_pi_v<float>;

}  // namespace

SenderSurfaces::SenderSurfaces(const graph::PassContext& context, graph::ObjectRef surfaces,
                               const Parameters& parameters)
    : surfaces_(context.object<passes::SurfaceLookup>(surfaces)),
      scene_(*context.inputs().scene),
      world_(*context.inputs().world),
      materials_(parameters.transport.materials),
      is_glossy_(sends_highlights(parameters)),
      light_offset_(parameters.light_offset),
      highlight_share_(highlight_share(parameters)) {}

SenderSurfaces::Place SenderSurfaces::place(std::uint32_t triangle, glm::vec2 weights, glm::vec3 position_ws,
                                            float radius, glm::vec3 direction_ws) const {
    return {
        surfaces_->at({.distance = 0, .triangle = triangle, .u = weights.x, .v = weights.y}, direction_ws),
        position_ws, light_offset_ * radius};
}

HostSenders::HostSenders(const graph::PassContext& context, graph::ObjectRef surfaces,
                         const passes::ShadowMaps& shadow, const Parameters& parameters)
    : SenderSurfaces(context, surfaces, parameters),
      lights_(context.inputs().world->lights),
      shadows_(context, shadow) {}

/// Of lights without extent that shine there: `reflect(direction to the light)` times what arrives.
template <class Reflect>
glm::vec3 HostSenders::sum_of_lights(const Place& place, const Reflect& reflect) const {
    const auto& s = place.surface;
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (!passes::is_punctual(lights_[i])) continue;
        const auto light = passes::punctual_arrival(lights_[i], place.position_ws);
        if (!light || light->irradiance == glm::vec3(0)) continue;
        const float cosine = glm::dot(s.shading_normal_ws, light->direction_ws);
        if (cosine <= 0 || glm::dot(s.geometric_normal_ws, light->direction_ws) <= 0) continue;
        const auto raised = place.position_ws + place.lift * s.geometric_normal_ws;
        const auto visible = shadows_.visibility(i, raised, s.geometric_normal_ws, light->direction_ws);
        if (visible == glm::vec3(0)) continue;
        sum += reflect(light->direction_ws) * light->irradiance * cosine * visible;
    }
    return sum;
}

/// Seen from above the interface lets as much of it through as of light along the normal.
glm::vec3 SenderSurfaces::of_extended(const passes::Surface& s, glm::vec3 irradiance) const {
    if (irradiance == glm::vec3(0)) return irradiance;
    return one_over_pi * albedo(s) * below_interface(s, s.shading_normal_ws) * irradiance;
}

glm::vec3 HostSenders::diffuse(const Place& place, glm::vec3 extended) const {
    const auto& s = place.surface;
    const auto colour = albedo(s);
    if (colour == glm::vec3(0)) return glm::vec3(0);
    const auto sum = sum_of_lights(place, [&](glm::vec3 l) { return below_interface(s, l); });
    return one_over_pi * colour * sum + of_extended(s, extended);
}

float SenderSurfaces::widen(passes::Surface& s, glm::vec3 direction_ws, float variance) const {
    const float own = s.roughness;
    s.roughness = passes::widened_roughness(own, variance);
    return passes::widened_gain(own, s.roughness, glm::dot(s.shading_normal_ws, -direction_ws));
}

glm::vec3 HostSenders::glossy_rest(Place place, glm::vec3 direction_ws, float variance) const {
    auto& s = place.surface;
    if (!are_glossy() || s.is_unlit) return glm::vec3(0);
    const float gain = widen(s, direction_ws, variance);
    const auto stored = one_over_pi * albedo(s);
    return gain * sum_of_lights(place, [&](glm::vec3 l) {
               return whole_brdf(s, l, -direction_ws) - stored * below_interface(s, l);
           });
}

glm::vec3 HostSenders::all(Place place, glm::vec3 direction_ws, float variance) const {
    auto& s = place.surface;
    if (!are_glossy() || s.is_unlit) return diffuse(place, glm::vec3(0));
    const float gain = widen(s, direction_ws, variance);
    const auto stored = one_over_pi * albedo(s);
    return sum_of_lights(place, [&](glm::vec3 l) {
        return gain * whole_brdf(s, l, -direction_ws) + (1 - gain) * stored * below_interface(s, l);
    });
}

float SenderSurfaces::ray_slope_variance(std::uint32_t triangle, float distance_m, float density) const {
    if (highlight_share_ == 0) return 0;
    return passes::slope_variance(world_, triangle, distance_m, highlight_share_ / density);
}

float SenderSurfaces::ior(const passes::Surface& surface) const {
    return scene_.materials[static_cast<std::size_t>(surface.material)].ior;
}

/// diffuse_albedo of sent.glsl.
glm::vec3 SenderSurfaces::albedo(const passes::Surface& s) const {
    if (s.is_unlit) return glm::vec3(0);
    if (materials_ == Materials::lambert) return s.base_colour;
    return (1 - s.metallic) * (1 - s.transmission * (1 - s.metallic)) * s.base_colour;
}

glm::vec3 SenderSurfaces::below_interface(const passes::Surface& s, glm::vec3 to_light_ws) const {
    if (materials_ != Materials::gltf) return glm::vec3(1);
    const auto f0 = passes::layered_f0(ior(s), s.base_colour, s.metallic);
    const auto n = s.shading_normal_ws, h = passes::half_vector(n, to_light_ws, n);
    return 1.0f - passes::schlick_fresnel(f0, std::clamp(glm::dot(n, h), 0.0f, 1.0f));
}

/// Of the part that is no glass: gltf_brdf or metalness_blend_brdf of lib/brdf.glsl.
glm::vec3 SenderSurfaces::whole_brdf(const passes::Surface& s, glm::vec3 l, glm::vec3 v) const {
    const bool is_layered = materials_ == Materials::gltf;
    const auto n = s.shading_normal_ws;
    const auto h = passes::half_vector(n, l, v);
    const float alpha = std::max(s.roughness * s.roughness, passes::mirror_alpha);
    const auto f0 = is_layered ? passes::layered_f0(ior(s), s.base_colour, s.metallic) : s.base_colour;
    const auto fresnel = passes::schlick_fresnel(f0, std::clamp(glm::dot(v, h), 0.0f, 1.0f));
    const float n_dot_h = std::clamp(glm::dot(n, h), 0.0f, 1.0f);
    const float n_dot_l = glm::dot(n, l), n_dot_v = std::max(glm::dot(n, v), passes::min_view_cosine);
    const float visibility = is_layered ? passes::smith_visibility(n_dot_l, n_dot_v, alpha)
                                        : passes::smith_masking_over_2_cosine(n_dot_l, alpha) *
                                              passes::smith_masking_over_2_cosine(n_dot_v, alpha);
    const float lobe = passes::ggx_distribution(n_dot_h, alpha) * visibility;
    const auto below = one_over_pi * (1 - s.metallic) * s.base_colour;
    const float opaque = 1 - s.transmission * (1 - s.metallic);
    if (is_layered) return opaque * ((1.0f - fresnel) * below + lobe * fresnel);
    return opaque * (below + s.metallic * lobe * fresnel);
}

}  // namespace ir::methods::deep_screen_space
