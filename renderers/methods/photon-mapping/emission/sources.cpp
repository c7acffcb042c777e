#include "renderers/methods/photon-mapping/emission/sources.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/emitted_power.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/scene/light_data.h"

namespace ir::methods::photon_mapping {
namespace {

using passes::ShadowViewData;

/// The environment's part of what rays are divided by: most of its light misses what the bounds hold.
constexpr float max_environment = 3;

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
    if (light.type == scene::LightType::point) return 4 * pi / 6;
    return passes::shadow_layers(light) == 1 ? passes::punctual_solid_angle(light)
                                             : solid_angle_of_face(light, view);
}

SourceData source_of(const scene::Light& light, int index) {
    SourceData source{};
    source.origin_ws = light.position;
    source.perspective = light.type == scene::LightType::directional ? 0 : 1;
    source.direction_ws = light.direction;
    source.light = light_name(index);
    source.intensity = light.colour * light.intensity;
    return source;
}

SourceData layer_of(const scene::Light& light, const ShadowViewData& view) {
    auto source = source_of(light, view.light);
    if (view.perspective == 0) source.origin_ws = view.origin_ws;
    if (light.type == scene::LightType::point) source.direction_ws = view.forward_ws;
    source.flux = passes::channel_mean(source.intensity) * extent_of_layer(light, view);
    return source;
}

/// Gives each light all of its layers or none.
void add_layers(Sources& sources, const scene::World& world, int resolution) {
    int layers = 0, light = -1;
    bool has_room = false;
    for (const auto& view : passes::shadow_views(world, resolution)) {
        const auto& source = world.lights[static_cast<std::size_t>(view.light)];
        if (view.light != light) {
            light = view.light;
            has_room = layers + passes::shadow_layers(source) <= max_layers;
            if (has_room) layers += passes::shadow_layers(source);
        }
        if (!has_room) continue;
        sources.views.push_back(view);
        sources.layers.push_back(layer_of(source, view));
        sources.layer_flux += sources.layers.back().flux;
    }
}

void add_traced(Sources& sources, SourceData row, float power) {
    row.flux = power;
    row.is_traced = 1;
    sources.traced_rows.push_back(row);
}

void add_traced_lights(Sources& sources, const scene::World& world, const passes::EntryBox& box) {
    for (int i = 0; i < static_cast<int>(world.lights.size()); ++i) {
        if (std::ranges::any_of(sources.views, [&](const auto& view) { return view.light == i; })) continue;
        const auto& light = world.lights[static_cast<std::size_t>(i)];
        const float power = passes::emitted_power(light, box);
        if (!(power > 0)) continue;
        sources.traced.lights.push_back(i);
        sources.traced_flux += power;
        add_traced(sources, source_of(light, i), power);
    }
}

/// Of what is no light of the scene.
SourceData unplaced(std::uint32_t light, const scene::World& world, float perspective) {
    SourceData source{};
    source.origin_ws = world.bounds.centre();
    source.perspective = perspective;
    source.light = light;
    return source;
}

void add_environment(Sources& sources, const scene::Scene& scene, const scene::World& world,
                     const passes::EntryBox& box) {
    const float power = passes::emitted_power(scene.environment, box), others = sources.flux();
    // of a map what shines may lie between the texels that were looked at
    if (!(power > 0) && !scene.environment.map) return;
    sources.traced.environment = true;
    sources.traced_flux += others > 0 ? std::min(power, max_environment * others) : std::max(power, 1e-6f);
    sources.largest_flux = power;
    add_traced(sources, unplaced(light_sky, world, 0), power);
}

}  // namespace

std::uint32_t light_name(int emitter) {
    if (emitter == passes::EmissionSampler::emissive_mesh) return light_mesh;
    if (emitter == passes::EmissionSampler::environment) return light_sky;
    return std::min(static_cast<std::uint32_t>(emitter), light_beyond);
}

Sources find_sources(const graph::FrameInputs& inputs, const Parameters& parameters, int resolution) {
    const auto& scene = *inputs.scene;
    const auto& world = *inputs.world;
    const passes::EntryBox box(world.bounds);
    Sources sources;
    sources.traced = {.environment = false, .emissive_meshes = false};
    if (parameters.first_hit == FirstHit::rsm) add_layers(sources, world, resolution);
    add_traced_lights(sources, world, box);
    if (const float power = passes::emitted_power_of_meshes(scene, world); power > 0) {
        sources.traced.emissive_meshes = true;
        sources.traced_flux += power;
        add_traced(sources, unplaced(light_mesh, world, 1), power);
    }
    if (parameters.transport.environment_light) add_environment(sources, scene, world, box);
    sources.largest_flux = std::max(sources.largest_flux, sources.flux());
    return sources;
}

}  // namespace ir::methods::photon_mapping
