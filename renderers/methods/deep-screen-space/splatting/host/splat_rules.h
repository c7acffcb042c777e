#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "renderers/methods/deep-screen-space/splatting/host/host_glass.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/raytracing/bvh.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/sampling/pcg.h"
#include "shaders/methods/deep-screen-space/splatting/accepted.glsl.h"
#include "shaders/methods/deep-screen-space/splatting/visible_hit.glsl.h"

/// What influence.glsl, sub_image.glsl, visible_hit.glsl and accepted.glsl say, on the host.
namespace ir::methods::deep_screen_space {

/// Row · 2^level + column of the sub-image that a surfel is splatted into.
inline std::uint32_t random_sub_image(const Surfel& surfel, unsigned level, unsigned sample, unsigned seed) {
    const auto random = passes::pcg4d({surfel.identity, level, sample, seed});
    return random.y >> 16 << level >> 16 << level | random.x >> 16 << level >> 16;
}

/// Stratified, a surfel goes to the sub-image (order + this) mod 4^level.
inline std::uint32_t sub_image_offset(unsigned level, unsigned sample, unsigned seed) {
    return passes::pcg4d({0u, level, sample, seed}).x;
}

inline float first_shell(const InfluenceConstants& i, float radius) {
    return i.trade_off > 0 ? std::max(radius / std::sqrt(i.trade_off), i.shell_radius) : i.shell_radius;
}

/// Of a level, m: beyond `inner`, up to `outer`; empty where they are equal.
struct Shell {
    float inner, outer;
};
inline Shell shell_of(const InfluenceConstants& i, float radius, int level) {
    const float outer = std::ldexp(first_shell(i, radius), level);
    const float inner = level == 0 ? 0 : 0.5f * outer;
    return {std::min(inner, i.whole_reach),
            level == i.open_level ? i.whole_reach : std::min(outer, i.whole_reach)};
}

inline int splat_shell(const VisibleLevel& rules, int level, float radius, glm::vec3 x_ws,
                       glm::vec3 centre_ws) {
    const auto& i = rules.influence;
    const auto offset = centre_ws - x_ws;
    const float squared = glm::dot(offset, offset);
    if (squared > i.whole_reach * i.whole_reach) return -1;
    const float d = first_shell(i, radius);
    float reach = d * d;
    int shell = 0;
    while (shell < level && squared > reach) {
        reach *= 4;
        ++shell;
    }
    if ((squared > reach && level != i.open_level) || (!rules.full_discs && shell != level)) return -1;
    return shell;
}

inline float splat_disc_radius(const VisibleLevel& rules, int shell, float radius) {
    return std::ldexp(std::sqrt(rules.coverage) * radius, shell);
}

inline float splat_plane_distance(glm::vec3 x_ws, glm::vec3 direction_ws, glm::vec3 centre_ws,
                                  glm::vec3 normal_ws) {
    return glm::dot(normal_ws, centre_ws - x_ws) / glm::dot(normal_ws, direction_ws);
}

inline float splat_z(const InfluenceConstants& i, float t) {
    const float z = t * t / (i.whole_reach * i.whole_reach);
    return z < splat_last_z ? z : 1 - (1 - splat_last_z) * (splat_last_z / z);
}

/// The pixel that rays start from, and which discs count for it: accepted.glsl.
struct Receiver {
    glm::vec3 x_ws, geometric_normal_ws;
    Discs discs = Discs::above;
    bool clipped = false, open_backs = false;
    const passes::Bvh* bvh = nullptr;  ///< only where discs must be seen, or are clipped
    const HostGlass* glass = nullptr;  ///< only where it lets rays through

    bool accepts(const Surfel& surfel, glm::vec3 direction_ws, float distance, float disc_radius) const {
        if (open_backs && glm::dot(surfel.normal_ws, direction_ws) > 0) return false;
        if (discs != Discs::all && !is_above(surfel.centre_ws)) return false;
        if (glass &&
            glass->passes_glass(surfel.triangle, glm::dot(surfel.normal_ws, direction_ws), direction_ws))
            return false;
        if (clipped && !is_on_surface(x_ws + distance * direction_ws, surfel, disc_radius)) return false;
        return discs != Discs::seen || sees(surfel, direction_ws, disc_radius);
    }

  private:
    bool is_above(glm::vec3 centre_ws) const {
        const auto size = glm::max(glm::abs(x_ws), glm::abs(centre_ws));
        return glm::dot(geometric_normal_ws, centre_ws - x_ws) >
               splat_rounding * std::max(size.x, std::max(size.y, size.z));
    }
    bool is_on_surface(glm::vec3 met_ws, const Surfel& surfel, float disc_radius) const {
        const float depth = splat_depth * disc_radius;
        return bvh->occluded(met_ws + depth * surfel.normal_ws, -surfel.normal_ws, 0, 2 * depth);
    }
    bool sees(const Surfel& surfel, glm::vec3 direction_ws, float disc_radius) const {
        const auto origin = passes::offset_origin(x_ws, geometric_normal_ws);
        const bool is_back = glm::dot(surfel.normal_ws, direction_ws) > 0;
        const auto facing = is_back ? -surfel.normal_ws : surfel.normal_ws;
        const auto way = surfel.centre_ws + splat_lift * disc_radius * facing - origin;
        const float distance = glm::length(way);
        const auto to_centre = way / distance;
        const float far = splat_free_way * distance;
        if (!bvh->occluded(origin, to_centre, 0, far)) return true;
        return glass && !HostGlass::first_hit(*bvh, origin, to_centre, far, [&](std::uint32_t triangle) {
                             return glass->is_open_glass(triangle);
                         }).is_hit();
    }
};

}  // namespace ir::methods::deep_screen_space
