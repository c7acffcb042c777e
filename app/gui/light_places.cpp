#include "app/gui/light_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "widgets/image/camera_motion.h"
#include "widgets/image/decimals.h"

namespace ir::gui {
namespace {

using projects::LightSpec;

/// With three digits, which a person can read.
double rounded(double amount) {
    if (!(amount > 0) || !std::isfinite(amount)) return amount;
    const double digits = std::pow(10, std::floor(std::log10(amount)) - 2);
    return std::round(amount / digits) * digits;
}

/// W/sr that give white the radiance 2^-exposure at a distance: L = E / π, E = I / d².
double full_intensity(double distance, double exposure) {
    return std::numbers::pi * distance * distance * std::exp2(-exposure);
}

/// The camera's own place keeps its digits.
glm::dvec3 seen_place(const CameraPose& camera, const glm::dvec3& place) {
    return widgets::in_decimals(place, widgets::height_at(camera, place));
}

LightSpec point_light(const glm::dvec3& position, double intensity) {
    LightSpec light;
    light.position = position;
    light.quantity = LightSpec::Quantity::flux;
    light.amount = rounded(4 * std::numbers::pi * intensity);
    return light;
}

}  // namespace

LightSpec light_before(const engine::SurfacePoint& surface, const CameraPose& camera,
                       const scene::Bounds& bounds, double exposure) {
    double distance = std::min(surface.free_way / 2, widgets::height_at(camera, surface.position) / 4);
    if (!bounds.empty()) distance = std::min(distance, double(bounds.radius()) / 10);
    return point_light(seen_place(camera, surface.position + distance * surface.normal),
                       full_intensity(distance, exposure));
}

LightSpec light_from_camera(const CameraPose& camera, double aspect, const glm::dvec3& aim, double exposure) {
    constexpr double min_angle = 5, max_angle = 85;  // degrees
    const double distance = glm::length(aim - camera.eye);
    const double half_diagonal = widgets::height_at(camera, aim) * std::hypot(1, aspect) / 2;
    LightSpec light;
    light.type = LightSpec::Type::spot;
    light.position = camera.eye;
    light.target = seen_place(camera, aim);
    light.outer =
        std::round(std::clamp(glm::degrees(std::atan2(half_diagonal, distance)), min_angle, max_angle));
    light.inner = light.outer / 2;
    light.amount = rounded(full_intensity(distance, exposure));
    return light;
}

LightSpec headlight(const CameraPose& camera, const glm::dvec3& aim, double exposure) {
    return point_light(camera.eye, full_intensity(glm::length(aim - camera.eye), exposure));
}

LightSpec light_for_view(const CameraPose& camera, const scene::Bounds& bounds) {
    const auto axes = widgets::camera_axes(camera);
    const double distance = glm::length(camera.target - camera.eye);
    const auto up = glm::normalize(camera.up);
    const glm::vec3 eye(camera.eye);
    const bool is_inside =
        glm::all(glm::greaterThan(eye, bounds.min)) && glm::all(glm::lessThan(eye, bounds.max));
    const auto off = is_inside ? 0.35 * axes.forward + 0.1 * up : 0.4 * up - 0.5 * axes.right;
    return point_light(widgets::in_decimals(camera.eye + distance * off, distance),
                       full_intensity(distance, 0));
}

}  // namespace ir::gui
