#include "renderers/methods/ldm-indirect/tracing/host/overhang.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ir::methods::ldm_indirect {
namespace {

struct Sample {
    float along_p, along_q, squared;
};

/// Places of equal weight in Silverman's kernel, on a spiral.
std::array<Sample, overhang_samples> spiral() {
    std::array<Sample, overhang_samples> all;
    for (int i = 0; i < overhang_samples; ++i) {
        const float squared =
            1 - std::cbrt(1 - (static_cast<float>(i) + 0.5f) / static_cast<float>(overhang_samples));
        const float angle = static_cast<float>(i) * golden_angle, radius = std::sqrt(squared);
        all[static_cast<std::size_t>(i)] = {radius * std::cos(angle), radius * std::sin(angle), squared};
    }
    return all;
}

/// As spiral_turn() of overhang.glsl.
float spiral_turn(const Photon& photon) {
    return static_cast<float>((photon.source + (photon.leg & leg_map)) % 256u) * golden_angle;
}

}  // namespace

std::uint32_t part_beyond(const passes::ldm::PointTracer& map, const passes::ldm::MapFrame& frame,
                          const Photon& photon, const HostEllipse& e) {
    static const auto samples = spiral();
    // What a quantum is along n, in heights of the kernel.
    const float per_quantum =
        std::max(std::abs(glm::dot(e.n, glm::vec3(frame.direction))) * frame.direction.w / e.height, 1e-9f);
    const auto slope = map.slope_of(e.n);
    const auto centre = map.project(photon.centre_ws);
    const auto across = [&](const glm::vec3& axis) {
        return glm::vec3(glm::dot(glm::vec3(frame.u), axis), glm::dot(glm::vec3(frame.v), axis),
                         glm::dot(glm::vec3(frame.depth), axis));
    };
    const float cosine = std::cos(spiral_turn(photon)), sine = std::sin(spiral_turn(photon));
    const auto longer = across(e.longer * e.p), shorter = across(e.shorter * e.q);
    const auto p = cosine * longer + sine * shorter, q = cosine * shorter - sine * longer;
    float on_surface = 0;
    int known = 0;
    for (const auto& sample : samples) {
        const auto at = centre + sample.along_p * p + sample.along_q * q;
        const glm::vec2 texel = glm::floor(glm::vec2(at));
        if (!map.knows(static_cast<int>(texel.y))) continue;
        ++known;
        const float depth = at.z + glm::dot(slope, texel + 0.5f - glm::vec2(at));
        const auto entry = map.nearest(static_cast<int>(texel.x), static_cast<int>(texel.y), depth,
                                       std::sqrt(1 - sample.squared) / per_quantum);
        if (!entry) continue;
        const float off = (static_cast<float>(*entry) - depth) * per_quantum;
        const float left = (1 - sample.squared - off * off) / (1 - sample.squared);
        on_surface += left * left;
    }
    const float beyond = 64 * (1 - on_surface / static_cast<float>(std::max(known, 1)));
    return std::min(static_cast<std::uint32_t>(beyond + 0.5f), max_beyond);
}

}  // namespace ir::methods::ldm_indirect
