#include "renderers/methods/ldm-indirect/splatting/host/kernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderers/scene/frame.h"
#include "shaders/methods/ldm-indirect/splatting/ellipse.glsl.h"
#include "shaders/methods/ldm-indirect/splatting/footprint.glsl.h"

namespace ir::methods::ldm_indirect {
namespace {

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_nan(const glm::vec3& v) {
    return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
}

}  // namespace

MendedFootprints& MendedFootprints::operator+=(const MendedFootprints& other) {
    axes_short += other.axes_short, axes_long += other.axes_long;
    degenerate += other.degenerate, broken += other.broken;
    return *this;
}

float EllipseMaker::pixel_at(glm::vec3 position_ws) const {
    if (!c_.perspective) return c_.pixel_size;
    return c_.pixel_size * std::max(glm::dot(position_ws - c_.eye_ws, c_.view_axis_ws), c_.near_plane);
}

HostEllipse EllipseMaker::make(const Photon& photon, const glm::vec3& normal,
                               MendedFootprints& mended) const {
    const auto frame = scene::frame_around(normal);
    const bool broken = is_nan(photon.axis_u) || is_nan(photon.axis_v);
    const glm::vec3 longest(max_half_axis);
    const auto u = broken ? glm::vec3(0) : glm::clamp(c_.splat_size * photon.axis_u, -longest, longest);
    const auto v = broken ? glm::vec3(0) : glm::clamp(c_.splat_size * photon.axis_v, -longest, longest);
    const float ux = glm::dot(u, frame[0]), uy = glm::dot(u, frame[1]);
    const float vx = glm::dot(v, frame[0]), vy = glm::dot(v, frame[1]);
    const float xx = ux * ux + vx * vx, xy = ux * uy + vx * vy, yy = uy * uy + vy * vy;
    const float spread = std::sqrt(0.25f * (xx - yy) * (xx - yy) + xy * xy);
    float longer = std::sqrt(0.5f * (xx + yy) + spread);
    float shorter = longer > 0 ? std::abs(ux * vy - uy * vx) / longer : 0.0f;
    const auto direction = half_angle(0.5f * (xx - yy), xy, spread);
    const float least = c_.min_axis_pixels * pixel_at(photon.centre_ws);
    const float most = std::max(c_.longest_axis, least);
    mended.axes_short += shorter < least;
    mended.axes_long += longer > most;
    mended.degenerate += !(shorter > min_axis_ratio * longer);
    longer = std::clamp(longer, std::max(least, min_half_axis), most);
    shorter = std::clamp(shorter, std::max(least, min_axis_ratio * longer), longer);
    HostEllipse e;
    e.p = direction.x * frame[0] + direction.y * frame[1];
    e.q = direction.x * frame[1] - direction.y * frame[0];
    e.n = frame[2];
    e.longer = longer, e.shorter = shorter;
    // a = a' √|D_u x × D_v x| in M: the kernel ends so far from the plane
    e.height = std::sqrt(longer * shorter) / c_.topological_bias;
    return e;
}

glm::vec3 KernelMaker::to_source(const Photon& photon) const {
    if ((photon.leg & leg_direct) == 0) {
        const glm::vec3 along(arrivals_[std::min(photon.leg & leg_map, c_.map_count - 1)]);
        return (photon.leg & leg_along) != 0 ? -along : along;
    }
    if (c_.light_count == 0) return glm::vec3(0);
    const auto& light = arrivals_[c_.map_count + std::min(photon.leg >> leg_light_shift, c_.light_count - 1)];
    return light.w > 0.5f ? glm::normalize(glm::vec3(light) - photon.centre_ws) : -glm::vec3(light);
}

HostKernel KernelMaker::make(const Photon& photon, MendedFootprints& mended) const {
    const bool counts = (photon.leg & leg_direct) != 0 ? c_.count_direct : c_.count_indirect;
    if (!is_finite(photon.centre_ws) || !is_finite(photon.flux)) {
        ++mended.broken;
        return {};
    }
    if (!counts) return {};
    const bool is_direct = (photon.leg & leg_direct) != 0;
    HostKernel k;
    k.to_source_ws = to_source(photon);
    k.map = photon.leg & leg_map;
    k.distance = c_.clips && !is_direct ? photon.distance : 0.0f;
    const bool is_beam = k.distance > 0;
    const auto e =
        ellipses_.make(photon, is_beam ? k.to_source_ws : unpacked_direction(photon.normal), mended);
    k.centre_ws = photon.centre_ws;
    k.row_p = e.p / e.longer;
    k.row_q = e.q / e.shorter;
    k.row_n = e.n / e.height;
    // E_p π times Silverman's 3/π, and A_p = π |p| |q|
    k.peak =
        photon.flux * (3 * std::numbers::inv_pi_v<float> / (e.longer * e.shorter * part_on_surface(photon)));
    const float cosine = glm::dot(e.n, k.to_source_ws);
    if (is_beam)
        k.per_cosine = 1;
    else if (c_.turns_receivers && cosine < max_turned_cosine)
        k.per_cosine = 1 / std::max(cosine, min_turned_cosine);
    k.directed = (k.peak.x + k.peak.y + k.peak.z) * k.to_source_ws;
    k.counts = true;
    return k;
}

}  // namespace ir::methods::ldm_indirect
