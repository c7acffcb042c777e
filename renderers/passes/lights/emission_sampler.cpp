#include "renderers/passes/lights/emission_sampler.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/discrete_distribution.h"
#include "renderers/passes/lights/emitted_power.h"
#include "renderers/passes/lights/entry_box.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/lights/triangle_lights.h"
#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/microfacets.h"
#include "renderers/scene/frame.h"
#include "renderers/scene/light_sources.h"

namespace ir::passes {
namespace {

/// The environment is chosen at most so many times as often as all other emitters.
constexpr float max_environment = 3;

glm::vec3 cosine_about(glm::vec3 normal_ws, glm::vec2 u) {
    return glm::normalize(scene::frame_around(normal_ws) * sample_cosine_ts(u));
}

float cosine_pdf(glm::vec3 normal_ws, glm::vec3 direction_ws) {
    return std::max(glm::dot(normal_ws, direction_ws), 0.0f) / pi;
}

/// 1 - c of the cosine c to a spot's axis, distributed as its profile: 1 inside the inner cone,
/// ((c - o) / (i - o))² between the cones. Neighbours stay neighbours.
float spot_height(const scene::Light& light, float u) {
    const float half_sine = std::sin(0.5f * light.inner_angle), whole = 2 * half_sine * half_sine;
    const float inner = std::cos(light.inner_angle), outer = std::cos(light.outer_angle);
    const float rest = std::max(inner - outer, 0.0f) / 3, at = u * (whole + rest);
    if (at < whole || !(rest > 0)) return std::min(at, whole);
    return whole + (inner - outer) * (1 - std::cbrt(std::max(1 - (at - whole) / rest, 0.0f)));
}

/// The cosine to the axis is 1 - height, which is exact near the axis.
glm::vec3 direction_at(glm::vec3 axis_ws, float height, float turn) {
    const float sine = std::sqrt(std::max(height * (2 - height), 0.0f)), phi = 2 * pi * turn;
    return glm::normalize(scene::frame_around(axis_ws) *
                          glm::vec3(sine * std::cos(phi), sine * std::sin(phi), 1 - height));
}

float mean_radiance(const SurfaceLookup& surfaces, const TriangleLights::Triangle& t) {
    const auto& world = surfaces.world();
    const auto& factor = surfaces.scene().materials[world.triangle_materials[t.index]].emission;
    return t.radiance * channel_mean(factor) / luminance(factor);
}

}  // namespace

struct EmissionSampler::Impl {
    Impl(const SurfaceLookup& surfaces, const Options& options);

    std::optional<EmittedLight> from_light(std::size_t i, glm::vec2 place, glm::vec2 direction) const;
    std::optional<EmittedLight> from_triangle(std::size_t i, glm::vec2 place, glm::vec2 direction) const;
    std::optional<EmittedLight> from_sky(glm::vec2 place, glm::vec2 direction) const;
    float light_density(const scene::Light& light, glm::vec3 direction_ws, float distance) const;
    float sky_density(glm::vec3 direction_ws) const;
    EmittedLight from_far(glm::vec3 origin_ws, glm::vec3 direction_ws) const;

    std::vector<scene::Light> lights;
    std::vector<int> numbers;  ///< of lights in the world
    std::optional<TriangleLights> triangles;
    std::optional<EnvironmentLight> sky;
    EntryBox box;
    std::vector<float> powers;  ///< of lights; then of triangles; then of the environment
    DiscreteDistribution choice;
    float power = 0;
};

EmissionSampler::Impl::Impl(const SurfaceLookup& surfaces, const Options& options)
    : box(surfaces.world().bounds) {
    for (const int i : options.lights) {
        lights.push_back(surfaces.world().lights.at(static_cast<std::size_t>(i)));
        numbers.push_back(i);
        powers.push_back(emitted_power(lights.back(), box));
    }
    if (options.emissive_meshes) {
        triangles.emplace(surfaces);
        for (std::size_t i = 0; i < triangles->size(); ++i) {
            const auto& t = (*triangles)[i];
            powers.push_back(2 * pi * t.area * mean_radiance(surfaces, t));  // both sides
        }
    }
    double sum = 0;
    for (const float p : powers) sum += p;
    auto weights = powers;
    if (options.environment) {
        sky.emplace(surfaces.scene().environment);
        powers.push_back(pi * sky->mean_luminance() * box.area());
        const float most = sum > 0 ? static_cast<float>(max_environment * sum) : powers.back();
        weights.push_back(std::min(powers.back(), most));
        sum += powers.back();
    }
    power = static_cast<float>(sum);
    choice = DiscreteDistribution(weights.size(), [&](std::size_t i) { return weights[i]; });
}

std::optional<EmittedLight> EmissionSampler::Impl::from_light(std::size_t i, glm::vec2 place,
                                                              glm::vec2 direction) const {
    const auto& light = lights[i];
    if (light.type == scene::LightType::directional) {
        auto emitted = from_far(box.entry(light.direction, place), light.direction);
        emitted.flux = light.colour * light.intensity * box.area_across(light.direction);
        emitted.has_extent = false;
        return emitted;
    }
    EmittedLight emitted;
    if (scene::is_flat(light)) {
        const FlatLight shape(light);
        emitted.normal_ws = shape.normal_ws();
        emitted.origin_ws = offset_origin(shape.point_ws(place), emitted.normal_ws);
        emitted.direction_ws = cosine_about(emitted.normal_ws, direction);
        emitted.flux = pi * shape.area() * shape.radiance();
        emitted.area_pdf = 1 / shape.area();
        emitted.direction_pdf = cosine_pdf(emitted.normal_ws, emitted.direction_ws);
        return emitted;
    }
    const bool is_spot = light.type == scene::LightType::spot;
    const float height = is_spot ? spot_height(light, direction.x) : 2 * direction.x;
    emitted.origin_ws = light.position;
    emitted.direction_ws = emitted.normal_ws = direction_at(light.direction, height, direction.y);
    emitted.flux = light.colour * light.intensity * punctual_solid_angle(light);
    emitted.range = light.range;
    emitted.has_extent = false;
    const float profile =
        is_spot ? spot_profile(1 - height, std::cos(light.inner_angle), std::cos(light.outer_angle)) : 1;
    emitted.direction_pdf = profile / punctual_solid_angle(light);
    return emitted;
}

/// The first half of the directions is the winding's side.
std::optional<EmittedLight> EmissionSampler::Impl::from_triangle(std::size_t i, glm::vec2 place,
                                                                 glm::vec2 direction) const {
    const auto from = triangles->origin(i, place);
    if (!from) return std::nullopt;
    const auto& t = (*triangles)[i];
    const bool is_front = direction.x < 0.5f;
    const auto normal = glm::normalize(glm::cross(t.edge_u, t.edge_v));
    EmittedLight emitted;
    emitted.normal_ws = is_front ? normal : -normal;
    emitted.origin_ws = offset_origin(from->position_ws, emitted.normal_ws);
    emitted.direction_ws =
        cosine_about(emitted.normal_ws, {is_front ? 2 * direction.x : 2 * direction.x - 1, direction.y});
    emitted.flux = 2 * pi * t.area * from->radiance;
    emitted.emitter = emissive_mesh;
    emitted.triangle = t.index;
    emitted.area_pdf = 1 / t.area;
    emitted.direction_pdf = cosine_pdf(emitted.normal_ws, emitted.direction_ws) / 2;
    return emitted;
}

EmittedLight EmissionSampler::Impl::from_far(glm::vec3 origin_ws, glm::vec3 direction_ws) const {
    EmittedLight emitted;
    emitted.direction_ws = emitted.normal_ws = direction_ws;
    emitted.origin_ws = origin_ws;
    emitted.area_pdf = 1 / box.area_across(direction_ws);
    return emitted;
}

/// A constant shines through each point of the box by the cosine, so that all rays have the same flux. A map
/// chooses the direction first.
std::optional<EmittedLight> EmissionSampler::Impl::from_sky(glm::vec2 place, glm::vec2 direction) const {
    if (sky->is_constant()) {
        const auto point = box.point(place);
        const auto sample = sky->sample(point.normal_ws, direction);
        if (!(sample.pdf > 0) || sample.radiance == glm::vec3(0)) return std::nullopt;
        auto emitted = from_far(point.position_ws, -sample.direction_ws);
        emitted.flux = pi * box.area() * sample.radiance;
        emitted.emitter = environment;
        emitted.direction_pdf = 1 / (pi * box.area() * emitted.area_pdf);
        return emitted;
    }
    const auto sample = sky->sample(glm::vec3(0), direction);
    if (!(sample.pdf > 0) || sample.radiance == glm::vec3(0)) return std::nullopt;
    auto emitted = from_far(box.entry(-sample.direction_ws, place), -sample.direction_ws);
    emitted.flux = sample.radiance / (emitted.area_pdf * sample.pdf);
    emitted.emitter = environment;
    emitted.direction_pdf = sample.pdf;
    return emitted;
}

float EmissionSampler::Impl::light_density(const scene::Light& light, glm::vec3 direction_ws,
                                           float distance) const {
    if (scene::is_flat(light)) {
        const FlatLight shape(light);
        return glm::dot(shape.normal_ws(), direction_ws) > 0 ? 1 / (pi * shape.area()) : 0;
    }
    if (light.type == scene::LightType::directional) return 1 / box.area_across(light.direction);
    const float profile = light.type == scene::LightType::spot
                              ? spot_profile(glm::dot(light.direction, direction_ws),
                                             std::cos(light.inner_angle), std::cos(light.outer_angle))
                              : 1;
    return profile / (punctual_solid_angle(light) * distance * distance);
}

float EmissionSampler::Impl::sky_density(glm::vec3 direction_ws) const {
    if (sky->is_constant()) return 1 / (pi * box.area());
    return sky->pdf(glm::vec3(0), -direction_ws) / box.area_across(direction_ws);
}

float EmittedLight::density(float distance) const {
    if (!(area_pdf > 0)) return probability * direction_pdf / (distance * distance);
    if (!(direction_pdf > 0)) return probability * area_pdf;
    return probability * area_pdf * direction_pdf / glm::dot(normal_ws, direction_ws);
}

EmissionSampler::EmissionSampler(const SurfaceLookup& surfaces, const Options& options)
    : impl_(std::make_unique<Impl>(surfaces, options)) {}

EmissionSampler::~EmissionSampler() = default;

bool EmissionSampler::empty() const {
    return impl_->choice.empty();
}

float EmissionSampler::power() const {
    return impl_->power;
}

float EmissionSampler::power(int emitter) const {
    const auto lights = impl_->lights.size();
    if (emitter >= 0) {
        const auto at = std::ranges::find(impl_->numbers, emitter) - impl_->numbers.begin();
        return static_cast<std::size_t>(at) < lights ? impl_->powers[static_cast<std::size_t>(at)] : 0;
    }
    if (emitter == environment) return impl_->sky ? impl_->powers.back() : 0;
    double sum = 0;
    const auto count = impl_->triangles ? impl_->triangles->size() : 0;
    for (std::size_t i = 0; i < count; ++i) sum += impl_->powers[lights + i];
    return static_cast<float>(sum);
}

int EmissionSampler::emitter(float choice) const {
    const auto index = impl_->choice.sample(choice).index, lights = impl_->lights.size();
    if (index < lights) return impl_->numbers[index];
    return impl_->triangles && index < lights + impl_->triangles->size() ? emissive_mesh : environment;
}

std::optional<EmittedLight> EmissionSampler::sample(float choice, glm::vec2 place,
                                                    glm::vec2 direction) const {
    if (empty()) return std::nullopt;
    const auto chosen = impl_->choice.sample(choice);
    const auto lights = impl_->lights.size(), triangles = impl_->triangles ? impl_->triangles->size() : 0;
    std::optional<EmittedLight> emitted;
    if (chosen.index < lights) {
        emitted = impl_->from_light(chosen.index, place, direction);
        if (emitted) emitted->emitter = impl_->numbers[chosen.index];
    } else if (chosen.index < lights + triangles) {
        emitted = impl_->from_triangle(chosen.index - lights, place, direction);
    } else {
        emitted = impl_->from_sky(place, direction);
    }
    if (!emitted) return std::nullopt;
    emitted->probability = chosen.probability;
    emitted->flux /= chosen.probability;
    return emitted;
}

float EmissionSampler::density(int emitter, std::uint32_t triangle, glm::vec3 direction_ws,
                               float distance) const {
    if (empty()) return 0;
    const auto lights = impl_->lights.size();
    if (emitter == environment)
        return impl_->sky
                   ? impl_->choice.probability(impl_->powers.size() - 1) * impl_->sky_density(direction_ws)
                   : 0;
    if (emitter == emissive_mesh) {
        const int number = impl_->triangles ? impl_->triangles->find(triangle) : -1;
        if (number < 0) return 0;
        const auto i = static_cast<std::size_t>(number);
        return impl_->choice.probability(lights + i) / (2 * pi * (*impl_->triangles)[i].area);
    }
    const auto at =
        static_cast<std::size_t>(std::ranges::find(impl_->numbers, emitter) - impl_->numbers.begin());
    if (at >= lights) return 0;
    return impl_->choice.probability(at) * impl_->light_density(impl_->lights[at], direction_ws, distance);
}

}  // namespace ir::passes
