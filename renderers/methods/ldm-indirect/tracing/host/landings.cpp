#include "renderers/methods/ldm-indirect/tracing/host/landings.h"

#include <algorithm>
#include <cmath>

#include "shaders/methods/ldm-indirect/beam.glsl.h"
#include "shaders/methods/ldm-indirect/tracing/landing.glsl.h"

namespace ir::methods::ldm_indirect {

float entry_error(const glm::vec3& normal, const glm::vec3& direction, const glm::vec3& step_u,
                  const glm::vec3& step_v) {
    const float slope = (std::abs(glm::dot(normal, step_u)) + std::abs(glm::dot(normal, step_v))) /
                        std::max(std::abs(glm::dot(normal, direction)), 1e-3f);
    return std::min(slope, 8 * std::max(glm::length(step_u), glm::length(step_v)));
}

LandingView::LandingView(const LandingConstants& constants, const Parameters& parameters, glm::ivec2 size,
                         std::span<const glm::vec4> position, std::span<const glm::vec4> geometric_normal)
    : c_(constants),
      reject_hidden_(parameters.reject_hidden),
      tolerance_(parameters.visibility_tolerance),
      size_(size),
      position_(position),
      geometric_normal_(geometric_normal) {
    const auto rows = glm::transpose(c_.clip_from_world);
    depth_row_ = rows[3];
    for (int side = 0; side < 5; ++side) {
        sides_[side] = rows[3];
        if (side < 4) sides_[side] += (side % 2 == 0 ? 1.0f : -1.0f) * rows[side / 2];
        side_lengths_[side] = glm::length(glm::vec3(sides_[side]));
    }
}

bool LandingView::shown_at(const glm::vec3& position_ws, std::size_t& pixel) const {
    const auto clip = c_.clip_from_world * glm::vec4(position_ws, 1);
    const float per_w = 1 / std::max(clip.w, c_.nearest_w);
    const auto place = [per_w](float along, int size) {
        const float part = std::clamp(along * per_w, -1.0f, 1.0f) * 0.5f + 0.5f;
        return std::clamp(static_cast<int>(part * static_cast<float>(size)), 0, size - 1);
    };
    pixel = static_cast<std::size_t>(place(-clip.y, size_.y)) * static_cast<std::size_t>(size_.x) +
            static_cast<std::size_t>(place(clip.x, size_.x));
    return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

bool LandingView::may_reach_view(const glm::vec3& position_ws, const glm::vec3& first_ws,
                                 const glm::vec3& last_ws, float longer, float thicker) const {
    const float least =
        c_.shortest_axis * std::max(glm::dot(depth_row_, glm::vec4(position_ws, 1)), c_.nearest_w);
    const float radius =
        std::clamp(c_.splat_size * longer, least, std::max(c_.longest_axis, least)) * thicker;
    const glm::vec4 first(first_ws, 1), last(last_ws, 1);
    for (int side = 0; side < 5; ++side) {
        const float inmost = std::max(glm::dot(sides_[side], first), glm::dot(sides_[side], last));
        if (inmost < -radius * side_lengths_[side]) return false;
    }
    return true;
}

Landing LandingView::unseen(const Arrival& a, bool is_inside, float distance, const glm::vec3& normal) const {
    if (reject_hidden_) return {is_inside ? Cause::hidden : Cause::outside, distance, {}};
    if (is_inside) return {Cause::stored_hidden, distance, normal};
    float longer = a.spread.at_start + distance * a.spread.by_distance, thicker = 1;
    const auto position = a.origin + distance * a.direction;
    auto first = position, last = position;
    if (a.spread.is_beam) {
        first = a.origin + beam_begins * distance * a.direction;
        last = a.origin + beam_ends * distance * a.direction;
    } else {
        longer /= std::max(-glm::dot(normal, a.direction), min_facing);
        thicker = 1 / std::min(c_.topological_bias, 1.0f);
    }
    if (!may_reach_view(position, first, last, longer, thicker)) return {Cause::outside, distance, {}};
    return {Cause::stored_hidden, distance, normal};
}

Landing LandingView::land(const Arrival& a) const {
    float moved = a.distance;
    bool is_inside = false;
    for (int turn = 0; turn < 4; ++turn) {
        std::size_t pixel = 0;
        const auto place = a.origin + moved * a.direction;
        is_inside = shown_at(place, pixel);
        if (!is_inside && reject_hidden_) return {Cause::outside, a.distance, {}};
        const glm::vec3 normal(geometric_normal_[pixel]);
        if (normal == glm::vec3(0)) break;
        const auto& seen = position_[pixel];
        const float facing = glm::dot(normal, a.direction), gap = glm::dot(normal, glm::vec3(seen) - place);
        const bool is_near = std::abs(gap) <= tolerance_ * seen.w;
        if (!is_inside && facing > -min_facing) break;
        if (is_near && facing > -min_facing) {
            if (a.spread.is_beam && !reject_hidden_) break;
            if (a.has_surface && !reject_hidden_ && glm::dot(a.map_normal, normal) > opposite_surfaces) break;
            return {facing > min_facing ? Cause::back : Cause::degenerate, a.distance, {}};
        }
        if (std::abs(facing) <= min_facing) break;
        const float next = std::max(moved + gap / facing, 0.0f);
        const float allowed = a.error + entry_error(normal, a.direction, a.step_u, a.step_v);
        const bool is_explained = std::abs(next - a.distance) <= allowed;
        if (is_near) {
            const float at = is_explained ? next : moved;
            return is_inside ? Landing{Cause::stored, at, normal} : unseen(a, false, at, normal);
        }
        if (!is_explained) break;
        moved = next;
    }
    return unseen(a, is_inside, a.distance, a.map_normal);
}

}  // namespace ir::methods::ldm_indirect
