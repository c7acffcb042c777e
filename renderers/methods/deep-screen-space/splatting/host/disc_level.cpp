#include "renderers/methods/deep-screen-space/splatting/host/disc_level.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "renderers/core/constants.h"
#include "renderers/core/error.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Embree tests a little more than the discs; what is met is then tested as the device does it.
constexpr float room = 1 + 1e-5f;
/// Surfels that a thread looks at one after the other.
constexpr std::size_t together = 1024;

}  // namespace

/// The discs of a run of surfels.
struct DiscLevel::Run {
    std::vector<std::uint32_t> surfels;
    glm::vec3 low = glm::vec3(infinity), high = glm::vec3(-infinity);
};

DiscLevel::DiscLevel(RTCDevice device, std::span<const Surfel> surfels, const VisibleLevel& rules, int level,
                     const WhatIsSeen& seen, const std::function<std::uint32_t(const Surfel&)>& cell_of)
    : surfels_(surfels), rules_(rules), level_(level) {
    std::vector<Run> runs((surfels.size() + together - 1) / together);
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t i) {
        runs[i] = run(i * together, std::min((i + 1) * together, surfels.size()), seen);
    });
    Run all;
    for (const auto& run : runs) {
        all.surfels.insert(all.surfels.end(), run.surfels.begin(), run.surfels.end());
        all.low = glm::min(all.low, run.low);
        all.high = glm::max(all.high, run.high);
    }
    if (all.surfels.empty()) return;
    surfel_of_ = std::move(all.surfels);
    place_cells(all.low, all.high);
    build(device, cell_of);
}

DiscLevel::Run DiscLevel::run(std::size_t first, std::size_t end, const WhatIsSeen& seen) const {
    Run run;
    for (auto i = first; i < end; ++i) {
        const auto& s = surfels_[i];
        if (s.radius == 0) continue;  // there is a hole
        const auto shell = shell_of(rules_.influence, s.radius, level_);
        if (shell.inner >= shell.outer) continue;
        if (!seen.may_be_reached(s.centre_ws, shell.outer)) continue;
        run.surfels.push_back(static_cast<std::uint32_t>(i));
        const auto sines = glm::sqrt(glm::max(1.0f - s.normal_ws * s.normal_ws, glm::vec3(0)));
        const auto size = splat_disc_radius(rules_, level_, s.radius) * (sines + 1e-3f);
        run.low = glm::min(run.low, s.centre_ws - size);
        run.high = glm::max(run.high, s.centre_ws + size);
    }
    return run;
}

/// As many along each axis as keep coordinates small.
void DiscLevel::place_cells(glm::vec3 low, glm::vec3 high) {
    low_ = low;
    high_ = high;
    cell_ = (high - low) * 1.01f + 1e-3f;
    for (int i = 0; i < 2 * level_; ++i) {
        const auto extent = cell_ * glm::vec3(glm::uvec3(1) << shifts_);
        const auto least = std::min({extent.x, extent.y, extent.z});
        ++shifts_[least == extent.x ? 0 : least == extent.y ? 1 : 2];
    }
    const auto far = glm::max(glm::abs(low), glm::abs(high)) + cell_ * glm::vec3(glm::uvec3(1) << shifts_);
    rounding_ = 1e-6f * std::max({far.x, far.y, far.z});
}

glm::vec3 DiscLevel::offset(std::uint32_t cell) const {
    const auto mask = (glm::uvec3(1) << shifts_) - 1u;
    return cell_ * glm::vec3(glm::uvec3(cell, cell >> shifts_.x, cell >> (shifts_.x + shifts_.y)) & mask);
}

void DiscLevel::build(RTCDevice device, const std::function<std::uint32_t(const Surfel&)>& cell_of) {
    const auto geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* const vertices = static_cast<glm::vec4*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(glm::vec4), surfel_of_.size()));
    auto* const normals = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), surfel_of_.size()));
    if (!vertices || !normals)
        throw Error("deep screen space: no memory for " + std::to_string(surfel_of_.size()) +
                    " discs; raise surfel_radius");
    tbb::parallel_for(std::size_t{0}, surfel_of_.size(), [&](std::size_t i) {
        const auto& s = surfels_[surfel_of_[i]];
        vertices[i] = glm::vec4(s.centre_ws + offset(cell_of(s)),
                                splat_disc_radius(rules_, level_, s.radius) * room + rounding_);
        normals[i] = s.normal_ws;
    });
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
    rtcSetGeometryIntersectFilterFunction(geometry, filter);
    rtcCommitGeometry(geometry);
    scene_.reset(rtcNewScene(device));
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcJoinCommitScene(scene_.get());
}

/// Where the ray leaves the box of all discs.
float DiscLevel::exit(const DiscRay& ray) const {
    float result = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction_ws[axis] == 0) continue;
        const float side = ray.direction_ws[axis] > 0 ? high_[axis] : low_[axis];
        result = std::min(result, (side - ray.receiver.x_ws[axis]) / ray.direction_ws[axis]);
    }
    return result * room + rounding_;
}

void DiscLevel::filter(const RTCFilterFunctionNArguments* arguments) {
    auto& ray = *reinterpret_cast<DiscRay*>(arguments->context);
    const bool taken = ray.level->take(ray, RTCHitN_primID(arguments->hit, 1, 0));
    arguments->valid[0] = taken ? -1 : 0;
    // Discs of one plane are equally far but for rounding: none may hide another before both were tested.
    auto& far = RTCRayN_tfar(arguments->ray, 1, 0);
    if (taken) far = far * room + ray.level->rounding_;
}

void DiscLevel::query(DiscRay& ray, std::uint32_t cell, float near, float far) const {
    if (!scene_) return;
    far = std::min(far, exit(ray));
    if (!(near < far)) return;
    ray.level = this;
    const auto origin = ray.receiver.x_ws + offset(cell);
    RTCRayHit query{};
    query.ray.org_x = origin.x, query.ray.org_y = origin.y, query.ray.org_z = origin.z;
    query.ray.dir_x = ray.direction_ws.x, query.ray.dir_y = ray.direction_ws.y;
    query.ray.dir_z = ray.direction_ws.z;
    query.ray.tnear = std::max(0.99f * ray.known, near), query.ray.tfar = far;
    query.ray.mask = ~0u;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_.get(), &ray.context, &query);
}

/// Whether it is the new winner, by the tests of visible.frag; of equally near ones the first surfel is.
bool DiscLevel::take(DiscRay& ray, std::uint32_t primitive) const {
    const auto index = surfel_of_[primitive];
    const auto& s = surfels_[index];
    const auto x_ws = ray.receiver.x_ws;
    const auto to_centre = s.centre_ws - x_ws;
    const int shell = splat_shell(rules_, level_, s.radius, x_ws, s.centre_ws);
    if (shell < 0) return false;
    const float t = splat_plane_distance(x_ws, ray.direction_ws, s.centre_ws, s.normal_ws);
    if (!(t > ray.known) || (rules_.max_distance > 0 && t > rules_.max_distance)) return false;
    const float radius = splat_disc_radius(rules_, shell, s.radius);
    const auto from_centre = t * ray.direction_ws - to_centre;
    if (!(glm::dot(from_centre, from_centre) <= radius * radius)) return false;
    const float z = splat_z(rules_.influence, t);
    if (z > ray.z || (z == ray.z && (ray.winner == 0 || index + 1 >= ray.winner))) return false;
    if (!ray.receiver.accepts(s, ray.direction_ws, t, radius)) return false;
    ray.z = z;
    ray.winner = index + 1;
    return true;
}

}  // namespace ir::methods::deep_screen_space
