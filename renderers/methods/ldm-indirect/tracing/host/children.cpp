#include "renderers/methods/ldm-indirect/tracing/host/children.h"

#include <algorithm>
#include <cmath>

#include "renderers/scene/frame.h"

// What the functions are for, and where they deviate, stands in differentials.glsl.
namespace ir::methods::ldm_indirect {
namespace {

/// [Igehy99 eq. 10-12]
glm::vec3 transferred(const glm::vec3& change, const glm::vec3& turn, float t, const glm::vec3& direction,
                      const glm::vec3& normal) {
    const auto moved = change + t * turn;
    return moved - glm::dot(moved, normal) / glm::dot(direction, normal) * direction;
}

glm::vec3 mirrored(const glm::vec3& v, const glm::vec3& axis) {
    return v - 2 * glm::dot(v, axis) * axis;
}

/// By the shortest rotation that takes one direction to another. [Aalund15 §3.4]
class Rotation {
  public:
    Rotation(const glm::vec3& from, const glm::vec3& to) : from_(from), middle_(from + to) {
        const float size = glm::length(middle_);
        middle_ = size > 1e-5f ? middle_ / size : scene::any_tangent(to);
    }
    glm::vec3 operator()(const glm::vec3& v) const { return mirrored(mirrored(v, from_), middle_); }

  private:
    glm::vec3 from_, middle_;
};

struct Axes {
    glm::vec3 u, v;
};

Axes widened(const Axes& published, const glm::vec3& direction, const glm::vec3& normal, float t,
             float half_turn) {
    const auto across = scene::frame_around(direction), plane = scene::frame_around(normal);
    const glm::vec3 sides[] = {published.u, published.v,
                               transferred(glm::vec3(0), half_turn * across[0], t, direction, normal),
                               transferred(glm::vec3(0), half_turn * across[1], t, direction, normal)};
    float xx = 0, xy = 0, yy = 0;
    for (const auto& side : sides) {
        const float x = glm::dot(side, plane[0]), y = glm::dot(side, plane[1]);
        xx += x * x, xy += x * y, yy += y * y;
    }
    const float mean = 0.5f * (xx + yy), difference = 0.5f * (xx - yy);
    const float radius = std::sqrt(difference * difference + xy * xy);
    const float longest = mean + radius;
    const float shortest = longest > 0 ? std::max(xx * yy - xy * xy, 0.0f) / longest : 0.0f;
    const auto turn = half_angle(difference, xy, radius);
    const auto major = turn.x * plane[0] + turn.y * plane[1];
    return {std::sqrt(longest) * major, std::sqrt(shortest) * glm::cross(normal, major)};
}

}  // namespace

Photon photon_of(const Primary& primary, const Child& child, const glm::vec3& map_direction,
                 float half_turn) {
    const float cosine = glm::dot(primary.shading_ws, map_direction);
    const bool along = cosine > 0;
    const auto direction = along ? map_direction : -map_direction, normal = unpacked_direction(child.normal);
    const float t = child.distance;
    const Rotation rotated(primary.direction_ws, direction);
    Axes axes{transferred(primary.axis_u, rotated(primary.turn_u), t, direction, normal),
              transferred(primary.axis_v, rotated(primary.turn_v), t, direction, normal)};
    if (half_turn > 0) axes = widened(axes, direction, normal, t, half_turn);
    Photon result;
    result.centre_ws = primary.position_ws + t * direction;
    result.source = primary.source;
    result.axis_u = axes.u;
    result.axis_v = axes.v;
    result.leg = child.map | (along ? leg_along : 0u) | child.beyond << leg_beyond_shift |
                 primary.light << leg_light_shift;
    result.path_length = primary.path_length + child.distance;
    result.distance = child.distance;
    result.unused0 = result.unused1 = result.unused2 = 0;
    result.flux = reflected_flux(primary) * (std::abs(cosine) / primary.cosine_sum);
    result.normal = child.normal;
    return result;
}

}  // namespace ir::methods::ldm_indirect
