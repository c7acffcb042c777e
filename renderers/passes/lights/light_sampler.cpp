#include "renderers/passes/lights/light_sampler.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "renderers/passes/lights/discrete_distribution.h"
#include "renderers/passes/lights/environment_light.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/lights/triangle_lights.h"

namespace ir::passes {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

bool is_flat(const scene::Light& light) {
    return light.type == scene::LightType::rectangle || light.type == scene::LightType::disk;
}

/// What a light sends out, W; an infinite one onto a sphere around the scene.
float power_of(const scene::Light& light, float scene_radius) {
    const float intensity = luminance(light.colour * light.intensity);
    if (light.type == scene::LightType::directional) return intensity * pi * scene_radius * scene_radius;
    if (is_flat(light)) return intensity * pi * FlatLight(light).area();
    return intensity * punctual_solid_angle(light);
}

}  // namespace

struct LightSampler::Impl {
    Impl(const SurfaceLookup& surfaces, const Options& options);
    std::optional<LightSample> sample_light(std::size_t light, float probability, glm::vec3 position_ws,
                                            glm::vec2 u) const;
    std::optional<LightSample> sample_triangle(float choice, float probability, glm::vec3 position_ws,
                                               glm::vec2 u) const;
    std::optional<LightSample> sample_environment(float probability, glm::vec3 normal_ws, glm::vec2 u) const;

    struct Flat {
        FlatLight light;
        int index;  ///< of World::lights
    };
    std::vector<scene::Light> lights;
    std::vector<Flat> flat;
    std::vector<int> flat_of;  ///< per light: index into flat or -1
    std::optional<TriangleLights> triangles;
    std::optional<EnvironmentLight> environment;
    /// One item a light, then all triangles together, then the environment.
    DiscreteDistribution choice;
    DiscreteDistribution triangle_choice;
};

LightSampler::Impl::Impl(const SurfaceLookup& surfaces, const Options& options)
    : lights(surfaces.world().lights) {
    flat_of.assign(lights.size(), -1);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!is_flat(lights[i])) continue;
        flat_of[i] = static_cast<int>(flat.size());
        flat.push_back({FlatLight(lights[i]), static_cast<int>(i)});
    }
    if (options.emissive_meshes) triangles.emplace(surfaces);
    if (options.environment) environment.emplace(surfaces.scene().environment);

    const float radius = std::max(surfaces.world().bounds.radius(), 1e-3f);
    std::vector<float> powers;
    for (const auto& light : lights) powers.push_back(power_of(light, radius));
    float triangle_power = 0;
    if (triangles && triangles->size() > 0) {
        const auto power = [&](std::size_t i) {
            return 2 * pi * (*triangles)[i].area * (*triangles)[i].radiance;
        };
        for (std::size_t i = 0; i < triangles->size(); ++i) triangle_power += power(i);
        triangle_choice = DiscreteDistribution(triangles->size(), power);
    }
    powers.push_back(triangle_power);
    float finite = 0;
    for (const float power : powers) finite += power;
    float infinite = environment ? 4 * pi * pi * radius * radius * environment->mean_luminance() : 0.0f;
    if (finite > 0 && infinite > 0) infinite = std::clamp(infinite, 0.25f * finite, 3 * finite);
    powers.push_back(infinite);
    choice = DiscreteDistribution(powers.size(), [&](std::size_t i) { return powers[i]; });
}

std::optional<LightSample> LightSampler::Impl::sample_light(std::size_t light, float probability,
                                                            glm::vec3 position_ws, glm::vec2 u) const {
    if (const int number = flat_of[light]; number >= 0) {
        const auto& shape = flat[static_cast<std::size_t>(number)].light;
        const auto point = shape.sample(position_ws, u);
        if (!point) return std::nullopt;
        return LightSample{point->direction_ws, point->distance, shape.radiance(), probability * point->pdf,
                           false};
    }
    const auto arrival = punctual_arrival(lights[light], position_ws);
    if (!arrival) return std::nullopt;
    return LightSample{arrival->direction_ws, arrival->distance, arrival->irradiance, probability, true};
}

std::optional<LightSample> LightSampler::Impl::sample_triangle(float which, float probability,
                                                               glm::vec3 position_ws, glm::vec2 u) const {
    const auto chosen = triangle_choice.sample(which);
    const auto point = triangles->sample(chosen.index, position_ws, u);
    if (!point) return std::nullopt;
    return LightSample{point->direction_ws, point->distance, point->radiance,
                       probability * chosen.probability * point->pdf, false};
}

std::optional<LightSample> LightSampler::Impl::sample_environment(float probability, glm::vec3 normal_ws,
                                                                  glm::vec2 u) const {
    const auto sky = environment->sample(normal_ws, u);
    if (!(sky.pdf > 0) || sky.radiance == glm::vec3(0)) return std::nullopt;
    return LightSample{sky.direction_ws, std::numeric_limits<float>::infinity(), sky.radiance,
                       probability * sky.pdf, false};
}

LightSampler::LightSampler(const SurfaceLookup& surfaces, const Options& options)
    : impl_(std::make_unique<Impl>(surfaces, options)) {}

LightSampler::~LightSampler() = default;

bool LightSampler::empty() const {
    return impl_->choice.empty();
}

std::optional<LightSample> LightSampler::sample(glm::vec3 position_ws, glm::vec3 normal_ws, float choice,
                                                glm::vec2 u) const {
    if (empty()) return std::nullopt;
    const auto chosen = impl_->choice.sample(choice);
    const auto lights = impl_->lights.size();
    if (chosen.index < lights) return impl_->sample_light(chosen.index, chosen.probability, position_ws, u);
    if (chosen.index == lights)
        return impl_->sample_triangle(chosen.rest, chosen.probability, position_ws, u);
    return impl_->sample_environment(chosen.probability, normal_ws, u);
}

float LightSampler::pdf_of_triangle(glm::vec3 position_ws, glm::vec3, glm::vec3, const Hit& hit) const {
    if (!impl_->triangles) return 0;
    const int number = impl_->triangles->find(hit.triangle);
    if (number < 0) return 0;
    const auto i = static_cast<std::size_t>(number);
    return impl_->choice.probability(impl_->lights.size()) * impl_->triangle_choice.probability(i) *
           impl_->triangles->pdf(i, position_ws, hit.u, hit.v);
}

float LightSampler::pdf_of_light(glm::vec3 position_ws, glm::vec3, glm::vec3 direction_ws,
                                 const LightHit& hit) const {
    const auto light = static_cast<std::size_t>(hit.light);
    if (hit.light < 0 || light >= impl_->lights.size() || impl_->flat_of[light] < 0) return 0;
    const auto& shape = impl_->flat[static_cast<std::size_t>(impl_->flat_of[light])].light;
    return impl_->choice.empty() ? 0
                                 : impl_->choice.probability(light) * shape.pdf(position_ws, direction_ws);
}

float LightSampler::pdf_of_environment(glm::vec3, glm::vec3 normal_ws, glm::vec3 direction_ws) const {
    if (!has_environment()) return 0;
    return impl_->choice.probability(impl_->lights.size() + 1) *
           impl_->environment->pdf(normal_ws, direction_ws);
}

glm::vec3 LightSampler::environment(glm::vec3 direction_ws) const {
    return impl_->environment ? impl_->environment->radiance(direction_ws) : glm::vec3(0);
}

bool LightSampler::has_environment() const {
    return impl_->environment && !impl_->environment->empty();
}

int LightSampler::extended_lights() const {
    return static_cast<int>(impl_->flat.size());
}

std::optional<LightHit> LightSampler::intersect(int index, glm::vec3 origin_ws, glm::vec3 direction_ws,
                                                float far) const {
    const auto& [shape, light] = impl_->flat[static_cast<std::size_t>(index)];
    const auto distance = shape.intersect(origin_ws, direction_ws, far);
    if (!distance) return std::nullopt;
    return LightHit{*distance, shape.radiance(), light};
}

}  // namespace ir::passes
