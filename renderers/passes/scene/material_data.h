#pragma once

#include <vector>

#include "renderers/core/fields.h"
#include "renderers/scene/world.h"

namespace ir::passes {

/// A texture slot as struct TextureSlot of shaders/lib/material.glsl.
struct TextureSlotData {
    glm::vec2 offset, scale;
    float sine, cosine;
    int texture, uv_set;
    IR_FIELDS(offset, scale, sine, cosine, texture, uv_set)
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
    IR_FIELDS(base_colour, emission, metallic, roughness, normal_scale, alpha_cutoff, ior, transmission,
              thickness, attenuation_distance, flags, attenuation_colour, unused, base_colour_slot,
              metallic_roughness_slot, normal_slot, emission_slot, transmission_slot)
};

/// A material's opacity bitmap as struct OpacityBitmap of shaders/lib/coverage.glsl.
struct OpacityData {
    int width, height;
    std::uint32_t first_word, wraps;
    IR_FIELDS(width, height, first_word, wraps)
};

std::vector<MaterialData> material_data(const scene::Scene& scene);
/// One element per material of the scene.
std::vector<OpacityData> opacity_data(const scene::Scene& scene, const scene::World& world);

}  // namespace ir::passes
