#include "renderers/methods/reference/visibility.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderers/core/constants.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/scene/frame.h"

namespace ir::methods::reference {
namespace {

using Packet = passes::Bvh::Packet16;

constexpr std::uint64_t lanes = 16;

void set_origin(Packet& packet, std::uint64_t lane, glm::vec3 origin) {
    packet.ox[lane] = origin.x, packet.oy[lane] = origin.y, packet.oz[lane] = origin.z;
}

void set_direction(Packet& packet, std::uint64_t lane, glm::vec3 direction) {
    packet.dx[lane] = direction.x, packet.dy[lane] = direction.y, packet.dz[lane] = direction.z;
}

Packet idle_packet(float far) {
    Packet packet;
    for (std::uint64_t lane = 0; lane < lanes; ++lane) {
        set_origin(packet, lane, glm::vec3(0));
        set_direction(packet, lane, {0, 0, 1});
        packet.near[lane] = 0, packet.far[lane] = far, packet.active[lane] = 0;
    }
    return packet;
}

float reach(const VisibilityRule& rule) {
    return rule.max_distance > 0 ? rule.max_distance : infinity;
}

/// V of the active lanes; the others are left alone.
void trace(const passes::Bvh& bvh, const VisibilityRule& rule, const Packet& packet, float (&values)[lanes]) {
    if (rule.falloff == Transport::Falloff::hard || rule.max_distance == 0) {
        const unsigned blocked = bvh.occluded16(packet, false);
        for (std::uint64_t i = 0; i < lanes; ++i) {
            if (packet.active[i]) values[i] = (blocked >> i) & 1 ? 0.0f : 1.0f;
        }
        return;
    }
    float distances[lanes];
    bvh.closest16(packet, false, distances);
    for (std::uint64_t i = 0; i < lanes; ++i) {
        if (packet.active[i]) values[i] = visibility(rule, distances[i]);
    }
}

std::uint32_t active_in(const Packet& packet, std::uint64_t first, SampleRange range) {
    std::uint32_t active = 0;
    for (auto i = std::max(first, range.begin); i < std::min(first + lanes, range.end); ++i)
        active += packet.active[i - first] != 0;
    return active;
}

/// Adds the lanes of the packet from sample `first` on that lie in the range; returns how many are active.
std::uint32_t add_lanes(const Packet& packet, const float (&values)[lanes], std::uint64_t first,
                        SampleRange range, Sums& sums) {
    for (auto i = std::max(first, range.begin); i < std::min(first + lanes, range.end); ++i)
        sums[i % randomisations] += values[i - first];
    return active_in(packet, first, range);
}

}  // namespace

float visibility(const VisibilityRule& rule, float distance) {
    if (distance == infinity) return 1;
    if (rule.max_distance == 0) return 0;
    if (distance >= rule.max_distance) return 1;
    if (rule.falloff == Transport::Falloff::hard) return 0;
    const float t = distance / rule.max_distance;
    return t * t;
}

glm::vec3 cosine_direction(glm::vec2 u, glm::vec3 n) {
    // A uniform point of the disc, lifted to the hemisphere [Malley88].
    const float radius = std::sqrt(u.x), angle = glm::two_pi<float>() * u.y;
    return scene::frame_around(n) *
           glm::vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u.x));
}

PixelSamples::PixelSamples(std::uint64_t seed, std::uint32_t x, std::uint32_t y) {
    const auto key = passes::pixel_key(seed, x, y);
    for (std::size_t r = 0; r < sequences_.size(); ++r) sequences_[r] = passes::PointSequence(key + r);
}

glm::vec2 PixelSamples::point(std::uint64_t sample) const {
    return sequences_[sample % randomisations].point(static_cast<std::uint32_t>(sample / randomisations));
}

std::uint32_t add_visibility(const passes::Bvh& bvh, const SurfacePoint& point, const VisibilityRule& rule,
                             const PixelSamples& samples, SampleRange range, Sums& sums,
                             DirectionSampler direction) {
    auto packet = idle_packet(reach(rule));
    const auto origin = passes::offset_origin(point.position_ws, point.geometric_normal_ws);
    for (std::uint64_t lane = 0; lane < lanes; ++lane) set_origin(packet, lane, origin);
    std::uint32_t rays = 0;
    for (auto first = range.begin / lanes * lanes; first < range.end; first += lanes) {
        float values[lanes] = {};
        bool any = false;
        for (std::uint64_t lane = 0; lane < lanes; ++lane) {
            const auto towards = direction(samples.point(first + lane), point.shading_normal_ws);
            const bool above = glm::dot(towards, point.geometric_normal_ws) > 0;
            set_direction(packet, lane, towards);
            packet.active[lane] = above ? -1 : 0;
            any = any || above;
        }
        if (any) trace(bvh, rule, packet, values);
        rays += add_lanes(packet, values, first, range, sums);
    }
    return rays;
}

std::uint32_t add_visibility_through_pixel(const RayWorld& world, const passes::PixelRays& rays,
                                           glm::ivec2 pixel, std::uint64_t pixel_key,
                                           const VisibilityRule& rule, SampleRange range, Sums& sums) {
    std::uint32_t traced = 0;
    for (auto first = range.begin / lanes * lanes; first < range.end; first += lanes) {
        auto primary = idle_packet(infinity), secondary = idle_packet(reach(rule));
        passes::PathSampler samplers[lanes];
        glm::vec3 directions[lanes];
        for (std::uint64_t lane = 0; lane < lanes; ++lane) {
            const auto i = first + lane;
            samplers[lane] = passes::PathSampler(pixel_key + i % randomisations,
                                                 static_cast<std::uint32_t>(i / randomisations));
            const auto at = glm::vec2(pixel) + samplers[lane].pair(0);
            directions[lane] =
                glm::normalize(rays.direction + at.x * rays.direction_dx + at.y * rays.direction_dy);
            set_origin(primary, lane, rays.origin + at.x * rays.origin_dx + at.y * rays.origin_dy);
            set_direction(primary, lane, directions[lane]);
            primary.active[lane] = -1;
        }
        passes::Hit hits[lanes];
        world.bvh.closest_hits16(primary, true, hits);
        float values[lanes];
        bool any = false;
        for (std::uint64_t lane = 0; lane < lanes; ++lane) {
            values[lane] = hits[lane].is_hit() ? 0.0f : 1.0f;
            if (!hits[lane].is_hit()) continue;
            const auto surface = world.surfaces.at(hits[lane], directions[lane]);
            const auto towards = cosine_direction(samplers[lane].pair(1), surface.shading_normal_ws);
            if (glm::dot(towards, surface.geometric_normal_ws) <= 0) continue;
            set_origin(secondary, lane,
                       passes::offset_origin(surface.position_ws, surface.geometric_normal_ws));
            set_direction(secondary, lane, towards);
            secondary.active[lane] = -1;
            any = true;
        }
        if (any) trace(world.bvh, rule, secondary, values);
        traced += add_lanes(primary, values, first, range, sums) + active_in(secondary, first, range);
    }
    return traced;
}

}  // namespace ir::methods::reference
