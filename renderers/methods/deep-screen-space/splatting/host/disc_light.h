#pragma once

#include <span>

#include "renderers/methods/deep-screen-space/splatting/host/splat_rules.h"
#include "shaders/methods/deep-screen-space/splatting/disc_light.glsl.h"

namespace ir::methods::deep_screen_space {

/// What discs send that stand for many surfels: disc_light.glsl and sent_by_disc of resolve.comp, on the
/// host.
struct DiscLights {
    std::span<const Surfel> surfels;
    std::span<const SurfelLight> lights;
    VisibleLevel rules;
    int levels;
    unsigned seed;
    bool averaged;

    glm::vec3 of_side(std::size_t index, bool is_front) const {
        const auto& side = is_front ? lights[index].front : lights[index].back;
        return {side[0], side[1], side[2]};
    }

    /// Which the disc was enlarged for: that in which the pixel's point lies.
    int shell(std::size_t index, glm::vec3 x_ws) const {
        auto any = rules;
        any.full_discs = true;
        const auto& s = surfels[index];
        return std::max(splat_shell(any, levels - 1, s.radius, x_ws, s.centre_ws), 0);
    }

    /// `ray`: pixel and sample.
    glm::vec3 sent(std::size_t index, int shell, bool is_front, glm::uvec3 ray) const {
        if (!averaged) return of_side(index, is_front);
        return mean(index, shell, is_front, passes::unit_float(passes::pcg4d({ray, seed}).w));
    }

    /// As disc_slope_variance.
    float slope_variance(std::size_t index, int shell, float distance_m) const {
        const float wide = averaged ? std::ldexp(surfels[index].radius, shell) / distance_m : 0;
        return wide * wide / 16;
    }

  private:
    glm::vec3 mean(std::size_t index, int shell, bool is_front, float random) const {
        const auto& s = surfels[index];
        const int around = 1 << 2 * shell, picks = std::min(around, disc_light_picks);
        const float reach = splat_disc_radius(rules, shell, s.radius);
        glm::vec3 sum(0);
        int count = 0;
        for (int i = 0; i < picks; ++i) {
            const auto step = static_cast<float>(i) + random;
            const auto other = static_cast<std::int64_t>(index) +
                               static_cast<int>(step * static_cast<float>(around / picks)) - around / 2;
            if (other < 0 || other >= static_cast<std::int64_t>(surfels.size())) continue;
            const auto& o = surfels[static_cast<std::size_t>(other)];
            const auto offset = o.centre_ws - s.centre_ws;
            if (o.radius == 0 || glm::dot(o.normal_ws, s.normal_ws) < disc_light_facing ||
                glm::dot(offset, offset) > reach * reach)
                continue;
            sum += of_side(static_cast<std::size_t>(other), is_front);
            ++count;
        }
        return count > 0 ? sum / static_cast<float>(count) : of_side(index, is_front);
    }
};

}  // namespace ir::methods::deep_screen_space
