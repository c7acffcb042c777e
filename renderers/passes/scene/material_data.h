#pragma once

#include <vector>

#include "renderers/graph/resource.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// A texture slot as struct TextureSlot of shaders/lib/material.glsl.
struct TextureSlotData {
    glm::vec2 offset, scale;
    float sine, cosine;
    int texture, uv_set;
};

/// A material as struct Material of shaders/lib/material.glsl.
struct MaterialData {
    glm::vec4 base_colour;
    glm::vec3 emission;
    float metallic;
    float roughness, normal_scale, alpha_cutoff, ior;
    float transmission, thickness, attenuation_distance;
    std::uint32_t flags;
    glm::vec3 attenuation_colour;
    float unused;
    TextureSlotData base_colour_slot, metallic_roughness_slot, normal_slot, emission_slot, transmission_slot;
};

/// A material's opacity bitmap as struct OpacityBitmap of shaders/lib/coverage.glsl.
struct OpacityData {
    int width, height;
    std::uint32_t first_word, wraps;
};

std::vector<graph::Field> material_fields();
std::vector<graph::Field> opacity_fields();

std::vector<MaterialData> material_data(const scene::Scene& scene);
/// One element per material of the scene.
std::vector<OpacityData> opacity_data(const scene::Scene& scene, const scene::World& world);

}  // namespace ir::passes
