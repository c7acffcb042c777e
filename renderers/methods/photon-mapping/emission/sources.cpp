#include "renderers/methods/photon-mapping/emission/sources.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::methods::photon_mapping {
namespace {

using passes::ShadowViewData;

float mean(glm::vec3 rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3;
}

/// ∫ profile dω over a face of a cube of maps, in sr, by the midpoints of 64 × 64 texels.
float solid_angle_of_face(const scene::Light& light, const ShadowViewData& view) {
    constexpr int texels = 64;
    double sum = 0;
    for (int y = 0; y < texels; ++y)
        for (int x = 0; x < texels; ++x) {
            const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) * (2.0f / texels) - 1.0f;
            const auto direction = view.forward_ws + ndc.x * view.right_ws + ndc.y * view.up_ws;
            const float squared = glm::dot(direction, direction), size = std::sqrt(squared);
            const float cosine = glm::dot(direction, light.direction) / size;
            const float profile =
                light.type == scene::LightType::spot
                    ? passes::spot_profile(cosine, std::cos(light.inner_angle), std::cos(light.outer_angle))
                    : 1;
            sum += profile / (squared * size);
        }
    return static_cast<float>(sum * 4 / (texels * texels));
}

/// What the layer's intensity is multiplied by for its flux: sr, or m² of a directional light.
float extent_of_layer(const scene::Light& light, const ShadowViewData& view) {
    if (view.perspective == 0) return 4 * glm::length(view.right_ws) * glm::length(view.up_ws);
    if (light.type == scene::LightType::point) return 4 * std::numbers::pi_v<float> / 6;
    return passes::shadow_layers(light) == 1 ? passes::punctual_solid_angle(light)
                                             : solid_angle_of_face(light, view);
}

SourceData source_of(const scene::Light& light, int index, float extent) {
    SourceData source;
    source.origin_ws = light.position;
    source.perspective = light.type == scene::LightType::directional ? 0 : 1;
    source.direction_ws = light.direction;
    source.light = static_cast<std::uint32_t>(index);
    source.intensity = light.colour * light.intensity;
    source.flux = mean(source.intensity) * extent;
    return source;
}

/// The middle of a directional light's map, wherever its photons are found.
glm::vec3 near_plane_of(const scene::World& world, int light) {
    for (const auto& view : passes::shadow_views(world, 64))
        if (view.light == light) return view.origin_ws;
    return world.bounds.centre();
}

void count_others(Sources& sources, const scene::Scene& scene, const scene::World& world) {
    sources.count(scene, world);
    for (const auto& source : sources.elements) sources.flux += source.flux;
}

}  // namespace

std::vector<std::string> Sources::notes() const {
    return OtherLights::notes(!elements.empty(), std::to_string(max_sources) + " maps of lights");
}

Sources layers_of_lights(const scene::Scene& scene, const scene::World& world, int resolution) {
    Sources sources;
    int layers = 0, light_beyond = -1;
    for (const auto& view : passes::shadow_views(world, resolution)) {
        const auto& light = world.lights[static_cast<std::size_t>(view.light)];
        // a light has all of its layers or none
        const bool is_first = sources.views.empty() || sources.views.back().light != view.light;
        if (is_first && view.light != light_beyond) {
            layers += passes::shadow_layers(light);
            if (layers > max_sources) {
                light_beyond = view.light;
                layers -= passes::shadow_layers(light);
                ++sources.beyond;
            }
        }
        if (view.light == light_beyond) continue;
        sources.views.push_back(view);
        auto source = source_of(light, view.light, extent_of_layer(light, view));
        if (view.perspective == 0) source.origin_ws = view.origin_ws;
        if (light.type == scene::LightType::point) source.direction_ws = view.forward_ws;
        sources.elements.push_back(source);
    }
    count_others(sources, scene, world);
    return sources;
}

Sources traced_lights(const scene::Scene& scene, const scene::World& world) {
    Sources sources;
    const float radius = world.bounds.radius();
    for (int i = 0; i < static_cast<int>(world.lights.size()); ++i) {
        const auto& light = world.lights[static_cast<std::size_t>(i)];
        if (passes::shadow_layers(light) == 0) continue;
        if (sources.elements.size() == max_sources) {
            ++sources.beyond;
            continue;
        }
        const bool is_sun = light.type == scene::LightType::directional;
        const float extent =
            is_sun ? std::numbers::pi_v<float> * radius * radius : passes::punctual_solid_angle(light);
        auto source = source_of(light, i, extent);
        if (is_sun) source.origin_ws = near_plane_of(world, i);
        sources.elements.push_back(source);
    }
    count_others(sources, scene, world);
    return sources;
}

}  // namespace ir::methods::photon_mapping
