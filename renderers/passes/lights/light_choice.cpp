#include "renderers/passes/lights/light_choice.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/scene/light_sources.h"

namespace ir::passes {
namespace {

LightBounds bounds_of_flat(const FlatLight& light) {
    const auto reach = glm::abs(light.half_width_ws()) + glm::abs(light.half_height_ws());
    LightBounds bounds{light.centre_ws() - reach, light.centre_ws() + reach, light.normal_ws()};
    bounds.cos_normals = 1;
    bounds.intensity = luminance(light.radiance()) * light.area();
    return bounds;
}

LightBounds bounds_of(const scene::Light& light) {
    if (light.type == scene::LightType::directional) return {};  // not in the tree
    if (scene::is_flat(light)) return bounds_of_flat(FlatLight(light));
    LightBounds bounds{light.position, light.position, light.direction};
    bounds.intensity = luminance(light.colour * light.intensity);
    if (light.type == scene::LightType::spot) {
        bounds.cos_normals = std::cos(light.inner_angle);
        // Beyond the inner cone the rest of the outer one, and a little more for rounding.
        constexpr float rounding = 1e-3f;
        const float spread = std::max(light.outer_angle - light.inner_angle, 0.0f) + rounding;
        bounds.cos_emission = std::max(std::cos(spread), 0.0f);
    }
    return bounds;
}

LightBounds bounds_of(const TriangleLights::Triangle& t) {
    const auto b = t.corner + t.edge_u, c = t.corner + t.edge_v;
    LightBounds bounds{glm::min(t.corner, glm::min(b, c)), glm::max(t.corner, glm::max(b, c))};
    const auto normal = glm::normalize(glm::cross(t.edge_u, t.edge_v));
    if (std::isfinite(normal.x + normal.y + normal.z)) {
        bounds.axis = normal;
        bounds.cos_normals = 1;
        bounds.two_sided = true;
    }
    bounds.intensity = t.radiance * t.area;
    return bounds;
}

std::vector<LightBounds> all_bounds(const std::vector<scene::Light>& lights,
                                    const TriangleLights* triangles) {
    std::vector<LightBounds> bounds;
    for (const auto& light : lights) bounds.push_back(bounds_of(light));
    for (std::size_t i = 0; triangles && i < triangles->size(); ++i)
        bounds.push_back(bounds_of((*triangles)[i]));
    return bounds;
}

/// What all that the tree holds sends out, W.
float tree_power(const std::vector<scene::Light>& lights, const TriangleLights* triangles) {
    double power = 0;
    for (const auto& light : lights) {
        const float intensity = luminance(light.colour * light.intensity);
        if (scene::is_flat(light))
            power += pi * intensity * FlatLight(light).area();
        else if (light.type != scene::LightType::directional)
            power += intensity * punctual_solid_angle(light);
    }
    for (std::size_t i = 0; triangles && i < triangles->size(); ++i)
        power += 2 * pi * (*triangles)[i].area * (*triangles)[i].radiance;
    return static_cast<float>(power);
}

}  // namespace

LightChoice::LightChoice(const std::vector<scene::Light>& lights, const TriangleLights* triangles,
                         float environment_luminance, float scene_radius)
    : tree_(all_bounds(lights, triangles)) {
    // What falls on a sphere around the scene, W.
    const float disk = pi * scene_radius * scene_radius;
    float sun_power = 0;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float irradiance = luminance(lights[i].colour * lights[i].intensity);
        if (lights[i].type != scene::LightType::directional || !(irradiance > 0)) continue;
        suns_.push_back({static_cast<int>(i), -lights[i].direction, irradiance * disk});
        sun_power += suns_.back().weight;
    }
    // The environment gets a fair share even where a sun outshines it, and so do lamps by day: the greater
    // power says little about the light that arrives within walls.
    environment_weight_ = 4 * pi * disk * environment_luminance;
    if (environment_weight_ > 0 && sun_power > 0)
        environment_weight_ = std::clamp(environment_weight_, sun_power / 3, sun_power * 3);
    const float infinite = environment_weight_ + sun_power;
    if (!tree_.empty()) tree_weight_ = tree_power(lights, triangles);
    if (infinite > 0 && tree_weight_ > 0) tree_weight_ = std::clamp(tree_weight_, infinite / 3, infinite * 3);
}

bool LightChoice::empty() const {
    return !(tree_weight_ > 0) && !(environment_weight_ > 0) && suns_.empty();
}

float LightChoice::weight_of(const Sun& sun, glm::vec3 normal_ws) {
    if (normal_ws == glm::vec3(0)) return sun.weight;
    // Not by the cosine alone: shading normals differ.
    const float cosine = glm::dot(normal_ws, sun.to_light);
    return cosine > 0 ? sun.weight * (0.25f + 0.75f * cosine) : 0;
}

float LightChoice::total(glm::vec3 normal_ws) const {
    float sum = tree_weight_ + environment_weight_;
    for (const auto& sun : suns_) sum += weight_of(sun, normal_ws);
    return sum;
}

std::optional<LightChoice::Chosen> LightChoice::choose(LightReceiver& receiver, double u) const {
    const float sum = total(receiver.normal_ws);
    if (!(sum > 0)) return std::nullopt;
    double left = u * sum;
    if (left < tree_weight_) {
        const auto choice = tree_.choose(receiver, left / tree_weight_);
        if (!choice) return std::nullopt;
        return Chosen{static_cast<int>(choice->light), choice->probability * (tree_weight_ / sum)};
    }
    left -= tree_weight_;
    for (const auto& sun : suns_) {
        const float weight = weight_of(sun, receiver.normal_ws);
        if (left < weight) return Chosen{sun.light, weight / sum};
        left -= weight;
    }
    if (!(environment_weight_ > 0)) return std::nullopt;  // by rounding
    return Chosen{environment, environment_weight_ / sum};
}

float LightChoice::probability(LightReceiver& receiver, int emitter) const {
    const float sum = total(receiver.normal_ws);
    if (!(sum > 0) || emitter < 0) return 0;
    for (const auto& sun : suns_)
        if (sun.light == emitter) return weight_of(sun, receiver.normal_ws) / sum;
    return tree_.probability(receiver, static_cast<std::uint32_t>(emitter)) * (tree_weight_ / sum);
}

float LightChoice::environment_probability(glm::vec3 normal_ws) const {
    const float sum = total(normal_ws);
    return sum > 0 ? environment_weight_ / sum : 0;
}

}  // namespace ir::passes
