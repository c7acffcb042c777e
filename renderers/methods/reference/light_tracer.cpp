#include "renderers/methods/reference/light_tracer.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/gbuffer/pixel_rays.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/scene/frame.h"

namespace ir::methods::reference {
namespace {

/// Dimensions of a light path's sampler.
enum EmissionDimension : std::uint32_t { of_light, of_emission, first_arrival };
enum ArrivalDimension : std::uint32_t { lobe_and_roulette, next_direction, per_arrival };

/// Of the directions that light is sent to, sr; of directional lights the area through which it comes, m².
float measure(const scene::Light& light, float radius) {
    if (light.type == scene::LightType::directional) return pi * radius * radius;
    return light.type == scene::LightType::spot ? 2 * pi * (1 - std::cos(light.outer_angle)) : 4 * pi;
}

/// Around +Z, uniform over directions whose cosine is at least this.
glm::vec3 cone_direction(glm::vec2 u, float least_cosine) {
    const float z = 1 - u.x * (1 - least_cosine), radius = std::sqrt(std::max(0.0f, 1 - z * z));
    return {radius * std::cos(2 * pi * u.y), radius * std::sin(2 * pi * u.y), z};
}

}  // namespace

Film::Film(const scene::View& view) : width_(view.width), height_(view.height) {
    const auto rays = passes::pixel_rays(view);
    is_orthographic_ = rays.direction_dx == glm::vec3(0);
    const auto dx = is_orthographic_ ? rays.origin_dx : rays.direction_dx,
               dy = is_orthographic_ ? rays.origin_dy : rays.direction_dy;
    origin_ = rays.origin;
    axis_ = rays.direction;
    film_from_world_ = glm::inverse(glm::mat3(rays.direction, dx, dy));
    pixel_area_ = glm::length(glm::cross(dx, dy));
}

std::optional<Film::Seen> Film::see(glm::vec3 position_ws) const {
    const auto at = film_from_world_ * (position_ws - origin_);
    const float depth = at.x;
    if (!(depth > 0)) return std::nullopt;
    const auto pixel = is_orthographic_ ? glm::vec2(at.y, at.z) : glm::vec2(at.y, at.z) / depth;
    if (!(pixel.x >= 0 && pixel.x < static_cast<float>(width_) && pixel.y >= 0 &&
          pixel.y < static_cast<float>(height_)))
        return std::nullopt;
    Seen seen;
    seen.pixel = static_cast<std::uint32_t>(pixel.y) * static_cast<std::uint32_t>(width_) +
                 static_cast<std::uint32_t>(pixel.x);
    if (is_orthographic_) {
        seen.to_eye_ws = -axis_;
        seen.distance = depth;
        seen.importance = 1 / pixel_area_;
        return seen;
    }
    const auto way = origin_ - position_ws;
    seen.distance = glm::length(way);
    seen.to_eye_ws = way / seen.distance;
    // A pixel of area A at depth 1 has the solid angle A cos³ of the angle to the axis, cos = depth /
    // distance.
    seen.importance = seen.distance / (pixel_area_ * depth * depth * depth);
    return seen;
}

bool LightTracer::has_paths(const scene::World& world, const PathRules& rules,
                            const std::vector<bool>& specular) {
    return rules.max_scatterings() > 0 &&
           std::any_of(world.lights.begin(), world.lights.end(), passes::is_punctual) &&
           std::any_of(world.ranges.begin(), world.ranges.end(), [&](const auto& range) {
               return range.triangle_count > 0 && specular[static_cast<std::size_t>(range.material)];
           });
}

LightTracer::LightTracer(const PathWorld& world, const PathRules& rules, const scene::View& view)
    : world_(world), rules_(rules), film_(view) {
    const auto& bounds = world.surfaces.world().bounds;
    centre_ws_ = bounds.centre();
    radius_ = 1.001f * bounds.radius();
    float total = 0;
    for (const auto& light : world.surfaces.world().lights) {
        if (!passes::is_punctual(light)) continue;
        const float power = passes::luminance(light.colour * light.intensity) * measure(light, radius_);
        if (!(power > 0)) continue;
        sources_.push_back({light, power});
        total += power;
    }
    for (auto& source : sources_) source.probability /= total;
}

void LightTracer::trace(const passes::PathSampler& sampler, std::vector<Splat>& splats,
                        Counts& counts) const {
    auto path = emitted(sampler);
    while (path && arrive(*path, splats, counts)) ++path->events;
}

std::optional<LightTracer::Path> LightTracer::emitted(const passes::PathSampler& sampler) const {
    float left = sampler.pair(of_light).x;
    auto source = sources_.begin();
    while (source != sources_.end() && left >= source->probability) left -= (source++)->probability;
    if (source == sources_.end()) return std::nullopt;
    const auto& light = source->light;
    Path path;
    path.sampler = sampler;
    path.light = &light;
    path.power = light.colour * light.intensity * (measure(light, radius_) / source->probability);
    const auto u = sampler.pair(of_emission);
    const auto frame = scene::frame_around(light.direction);
    if (light.type == scene::LightType::directional) {
        const float r = radius_ * std::sqrt(u.x);
        path.direction = light.direction;
        path.origin =
            centre_ws_ + frame * glm::vec3(r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), -radius_);
        return path;
    }
    path.origin = light.position;
    const bool is_spot = light.type == scene::LightType::spot;
    path.direction = glm::normalize(frame * cone_direction(u, is_spot ? std::cos(light.outer_angle) : -1.0f));
    if (is_spot)
        path.power *= passes::spot_profile(glm::dot(path.direction, light.direction),
                                           std::cos(light.inner_angle), std::cos(light.outer_angle));
    if (path.power == glm::vec3(0)) return std::nullopt;
    return path;
}

void LightTracer::absorb(Path& path, int material, float distance) const {
    path.power *= passes::Bsdf::transmittance(world_.material(material), distance);
}

bool LightTracer::arrive(Path& path, std::vector<Splat>& splats, Counts& counts) const {
    const auto hit = world_.bvh.closest_hit(path.origin, path.direction, 0, infinity);
    ++counts.rays;
    if (!hit.is_hit()) return false;
    const bool is_first = path.events == 0;
    if (is_first && !world_.may_be_specular[static_cast<std::size_t>(world_.material_of(hit))]) return false;
    path.from_light += hit.distance;
    if (!is_first) path.way += hit.distance;
    if (rules_.max_distance > 0 && path.way > rules_.max_distance) return false;
    const auto surface = world_.surfaces.at(hit, path.direction);
    if (surface.is_unlit) return false;
    // Seen from inside without having come in: the light is within the medium.
    const bool is_glass = surface.transmission > 0 && rules_.materials != Transport::Materials::lambert;
    const bool begins_inside = path.medium < 0 && !surface.is_front && is_glass;
    if (path.medium >= 0 || begins_inside)
        absorb(path, begins_inside ? surface.material : path.medium, hit.distance);
    const passes::Bsdf bsdf(surface, world_.material(surface.material), rules_.materials);
    if (!is_first && rules_.count(path.scatterings + 1) && bsdf.has_smooth_part())
        connect(path, surface, bsdf, splats, counts);
    return go_on(path, surface, bsdf, counts);
}

void LightTracer::connect(const Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                          std::vector<Splat>& splats, Counts& counts) const {
    const auto seen = film_.see(surface.position_ws);
    if (!seen) return;
    auto light = path.power * seen->importance * bsdf.evaluate_importance(-path.direction, seen->to_eye_ws);
    if (path.scatterings == 0) light *= passes::range_window(path.light->range, path.from_light);
    if (light == glm::vec3(0)) return;
    const bool is_behind = glm::dot(surface.geometric_normal_ws, seen->to_eye_ws) < 0;
    const int medium = is_behind ? medium_behind(path, surface) : path.medium;
    if (medium >= 0) light *= passes::Bsdf::transmittance(world_.material(medium), seen->distance);
    const auto origin = passes::offset_origin(
        surface.position_ws, is_behind ? -surface.geometric_normal_ws : surface.geometric_normal_ws);
    ++counts.rays;
    if (world_.bvh.occluded(origin, seen->to_eye_ws, 0, seen->distance)) return;
    splats.push_back({seen->pixel, path.scatterings + 1, light});
}

int LightTracer::medium_behind(const Path& path, const passes::Surface& surface) const {
    if (!(world_.material(surface.material).thickness > 0)) return path.medium;
    return surface.is_front ? surface.material : -1;
}

bool LightTracer::go_on(Path& path, const passes::Surface& surface, const passes::Bsdf& bsdf,
                        Counts& counts) const {
    const auto dimension = first_arrival + path.events * per_arrival;
    const auto numbers = path.sampler.pair(dimension + lobe_and_roulette);
    const auto sample =
        bsdf.sample_importance(-path.direction, numbers.x, path.sampler.pair(dimension + next_direction));
    if (!sample) return false;
    if (sample->is_specular) {
        if (++path.specular_events > max_specular_events) {
            ++counts.cut;
            return false;
        }
    } else {
        if (path.events == 0) return false;  // the camera's
        if (path.scatterings == 0) path.power *= passes::range_window(path.light->range, path.from_light);
        if (++path.scatterings >= rules_.max_scatterings()) return false;
        path.way = 0;
        // Weights are reflectances, about; shading normals may make them larger.
        const float survival = Estimator::by_throughput(sample->weight);
        if (!(numbers.y < survival)) return false;
        path.power *= Estimator::compensation(survival);
    }
    path.power *= sample->weight;
    if (sample->is_transmitted) path.medium = medium_behind(path, surface);
    const auto side = sample->is_transmitted ? -surface.geometric_normal_ws : surface.geometric_normal_ws;
    path.origin = passes::offset_origin(surface.position_ws, side);
    path.direction = sample->wi;
    return true;
}

}  // namespace ir::methods::reference
