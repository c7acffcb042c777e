#include "renderers/passes/lights/emitted_power.h"

#include <algorithm>
#include <cmath>

#include "renderers/core/constants.h"
#include "renderers/passes/lights/flat_light.h"
#include "renderers/passes/lights/luminance.h"
#include "renderers/passes/lights/punctual.h"

namespace ir::passes {
namespace {

/// Over the sphere.
float mean_radiance(const Image& map) {
    constexpr int max_rows = 256, max_columns = 512;
    const int step_y = (map.height + max_rows - 1) / max_rows;
    const int step_x = (map.width + max_columns - 1) / max_columns;
    double sum = 0, weights = 0;
    for (int y = step_y / 2; y < map.height; y += step_y) {
        const double weight = std::sin(pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
        for (int x = step_x / 2; x < map.width; x += step_x) {
            const float* value = &map.pixels[map.index(x, y)];
            const float radiance = map.channels >= 3 ? channel_mean({value[0], value[1], value[2]})
                                                     : static_cast<float>(value[0]);
            if (radiance > 0 && std::isfinite(radiance)) sum += weight * static_cast<double>(radiance);
            weights += weight;
        }
    }
    return weights > 0 ? static_cast<float>(sum / weights) : 0;
}

/// Of both sides of these triangles.
double power_of(const scene::Scene& scene, const scene::World& world, const scene::MaterialRange& range) {
    const float radiance = channel_mean(scene.materials[static_cast<std::size_t>(range.material)].emission);
    if (!(radiance > 0)) return 0;
    double twice_area = 0;
    for (std::uint32_t i = 0; i < range.triangle_count; ++i) {
        const auto* corner = &world.indices[3 * (range.first_triangle + i)];
        const auto a = world.positions[corner[0]];
        twice_area += static_cast<double>(
            glm::length(glm::cross(world.positions[corner[1]] - a, world.positions[corner[2]] - a)));
    }
    return static_cast<double>(pi * radiance) * twice_area;
}

}  // namespace

float emitted_power(const scene::Light& light, const EntryBox& box) {
    const float strength = channel_mean(light.colour * light.intensity);
    switch (light.type) {
        case scene::LightType::rectangle:
        case scene::LightType::disk:
            return pi * FlatLight(light).area() * strength;
        case scene::LightType::directional:
            return box.area_across(light.direction) * strength;
        default:
            return punctual_solid_angle(light) * strength;
    }
}

float emitted_power_of_material(const scene::Scene& scene, const scene::World& world, int material) {
    double sum = 0;
    for (const auto& range : world.ranges)
        if (range.material == material) sum += power_of(scene, world, range);
    return static_cast<float>(sum);
}

float emitted_power_of_meshes(const scene::Scene& scene, const scene::World& world) {
    double sum = 0;
    for (const auto& range : world.ranges) sum += power_of(scene, world, range);
    return static_cast<float>(sum);
}

float emitted_power(const scene::Environment& environment, const EntryBox& box) {
    const float radiance = environment.map && !environment.map->empty()
                               ? mean_radiance(*environment.map)
                               : channel_mean(glm::max(environment.constant, glm::vec3(0)));
    return pi * radiance * box.area();
}

}  // namespace ir::passes
