#include <cmath>
#include <limits>

#include "app/engine/live_session.h"
#include "renderers/passes/raytracing/alpha_masks.h"

namespace ir::engine {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Hit {
    double distance = infinite;
    glm::dvec3 normal{0};  ///< of length one, towards where the ray comes from
};

/// By brute force [Möller97]: one ray now and then is not worth a hierarchy. The direction has length one.
Hit first_hit(const scene::World& world, const passes::AlphaMasks& masks, const glm::dvec3& origin,
              const glm::dvec3& direction, double min_distance) {
    Hit nearest;
    for (std::uint32_t t = 0; t < world.triangles(); ++t) {
        const auto corner = [&](std::uint32_t c) {
            return glm::dvec3(world.positions[world.indices[3 * t + c]]);
        };
        const auto a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
        const auto p = glm::cross(direction, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0) continue;
        const double u = glm::dot(origin - a, p) / determinant;
        if (!(u >= 0 && u <= 1)) continue;
        const auto q = glm::cross(origin - a, ab);
        const double v = glm::dot(direction, q) / determinant, distance = glm::dot(ac, q) / determinant;
        if (!(v >= 0 && u + v <= 1 && distance > min_distance && distance < nearest.distance)) continue;
        const auto normal = glm::cross(ab, ac);
        const double length = glm::length(normal);
        if (!(length > 0) || !std::isfinite(length)) continue;
        const bool is_masked = t >= world.opaque_triangles;
        if (is_masked && !masks.is_covered(t - world.opaque_triangles, float(u), float(v))) continue;
        nearest = {distance, (glm::dot(normal, direction) > 0 ? -1.0 : 1.0) / length * normal};
    }
    return nearest;
}

}  // namespace

SurfaceResult LiveSession::find_surface(const SurfaceRequest& request) const {
    SurfaceResult result{request.tag, {}, {}};
    const auto found = entries_.find(request.tag);
    const double length = glm::length(request.direction);
    if (found == entries_.end() || !found->second.execution || !(length > 0)) {
        result.error = "nothing is rendered yet";
        return result;
    }
    const auto& execution = *found->second.execution;
    const bool has_world = execution.inputs().scene != nullptr;
    const auto made =
        has_world ? scene::World() : scene::flatten(execution.scene(), execution.time(), execution.time());
    const auto& world = has_world ? execution.world() : made;
    const passes::AlphaMasks masks(execution.scene(), world);
    const auto direction = request.direction / length;
    const auto hit = first_hit(world, masks, request.origin, direction, 0);
    if (!std::isfinite(hit.distance)) return result;
    SurfacePoint point{request.origin + hit.distance * direction, hit.normal, 0};
    constexpr double own_surface = 1e-4;  // part of the distance, in which single precision may lie
    point.free_way = first_hit(world, masks, point.position, hit.normal, own_surface * hit.distance).distance;
    result.point = point;
    return result;
}

}  // namespace ir::engine
