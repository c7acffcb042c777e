#include "renderers/methods/reference/visibility.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::reference {
namespace {

constexpr std::uint64_t lanes = 16;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Columns: tangent, bitangent, n [Duff17, listing 3].
glm::mat3 frame_around(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

void set_direction(passes::Bvh::Packet16& packet, std::uint64_t lane, glm::vec3 direction, bool above) {
    packet.dx[lane] = direction.x, packet.dy[lane] = direction.y, packet.dz[lane] = direction.z;
    packet.active[lane] = above ? -1 : 0;
}

passes::Bvh::Packet16 packet_from(const SurfacePoint& point, const VisibilityRule& rule) {
    const auto origin = passes::offset_origin(point.position_ws, point.geometric_normal_ws);
    passes::Bvh::Packet16 packet;
    for (std::uint64_t lane = 0; lane < lanes; ++lane) {
        packet.ox[lane] = origin.x, packet.oy[lane] = origin.y, packet.oz[lane] = origin.z;
        packet.near[lane] = 0;
        packet.far[lane] = rule.max_distance > 0 ? rule.max_distance : infinity;
    }
    return packet;
}

/// V of the active lanes; the others are left alone.
void trace(const passes::Bvh& bvh, const VisibilityRule& rule, const passes::Bvh::Packet16& packet,
           float (&values)[lanes]) {
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
    return frame_around(n) *
           glm::vec3(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - u.x));
}

PixelSamples::PixelSamples(std::uint64_t seed, std::uint32_t x, std::uint32_t y) {
    const auto key = pixel_key(seed, x, y);
    for (std::size_t r = 0; r < sequences_.size(); ++r) sequences_[r] = PointSequence(key + r);
}

glm::vec2 PixelSamples::point(std::uint64_t sample) const {
    return sequences_[sample % randomisations].point(static_cast<std::uint32_t>(sample / randomisations));
}

std::uint32_t add_visibility(const passes::Bvh& bvh, const SurfacePoint& point, const VisibilityRule& rule,
                             const PixelSamples& samples, SampleRange range, Sums& sums,
                             DirectionSampler direction) {
    auto packet = packet_from(point, rule);
    std::array<double, randomisations> added{};
    std::uint32_t rays = 0;
    for (auto first = range.begin; first < range.end;) {
        // Packets start at multiples of 16, wherever a frame or a slice started.
        const auto end = std::min(range.end, (first / lanes + 1) * lanes);
        float values[lanes] = {};
        std::uint32_t active = 0;
        for (std::uint64_t lane = 0; lane < lanes; ++lane) packet.active[lane] = 0;
        for (auto i = first; i < end; ++i) {
            const auto towards = direction(samples.point(i), point.shading_normal_ws);
            const bool above = glm::dot(towards, point.geometric_normal_ws) > 0;
            set_direction(packet, i % lanes, towards, above);
            active += above;
        }
        if (active > 0) trace(bvh, rule, packet, values);
        for (auto i = first; i < end; ++i) added[i % randomisations] += values[i % lanes];
        rays += active;
        first = end;
    }
    for (std::size_t r = 0; r < added.size(); ++r) sums[r] = static_cast<float>(sums[r] + added[r]);
    return rays;
}

}  // namespace ir::methods::reference
