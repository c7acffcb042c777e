// One element of the buffer "scene.materials" (renderers/passes/scene/material_data.h writes it). Declare the
// buffer where it is used:
//
//   layout(std430) readonly buffer Materials { Material materials[]; };

/// Where and how a texture is looked up: uv' = offset + R (scale uv)  [glTF2 KHR_texture_transform].
// C++: ir::passes::TextureSlotData
struct TextureSlot {
    vec2 offset, scale;
    float sine, cosine;
    int texture;  // index into the scene's textures, or -1
    int uv_set;   // 0 or 1
};

// Bits of Material::flags.
// C++: ir::passes::*
const uint MATERIAL_UNLIT = 1u, MATERIAL_DOUBLE_SIDED = 2u, MATERIAL_MASKED = 4u;

/// What has a larger fraction of glass is mostly glass: drawn as what lies behind it, except where it shines.
// C++: ir::passes::mostly_glass
const float MOSTLY_GLASS = 0.5;

// C++: ir::passes::MaterialData
struct Material {
    vec4 base_colour;
    vec3 emission;  // W/(m² sr)
    float metallic;
    float roughness, normal_scale, alpha_cutoff, ior;
    float transmission, thickness, attenuation_distance;
    uint flags;
    vec3 attenuation_colour;
    float unused;
    TextureSlot base_colour_slot, metallic_roughness_slot, normal_slot, emission_slot, transmission_slot;
};

/// Fraction that survives `distance` metres inside the material; 1 where it has no volume.
/// [glTF2 KHR_materials_volume]
vec3 transmittance(Material material, float distance) {
    if (material.thickness <= 0.0 || material.attenuation_distance <= 0.0) return vec3(1);
    return pow(material.attenuation_colour, vec3(distance / material.attenuation_distance));
}

/// The slot's coordinates. `precise` keeps the rounding of scene::transformed_uv.
vec2 uv_of_slot(TextureSlot slot, vec2 uv0, vec2 uv1) {
    vec2 uv = slot.uv_set == 0 ? uv0 : uv1;
    precise vec2 scaled = slot.scale * uv;
    precise vec2 rotated = vec2(slot.cosine * scaled.x + slot.sine * scaled.y,
                                slot.cosine * scaled.y - slot.sine * scaled.x);
    precise vec2 moved = slot.offset + rotated;
    return moved;
}

/// The same of both sets together; 0 without a texture.
vec2 slot_uv(TextureSlot slot, vec4 uv01) { return slot.texture < 0 ? vec2(0) : uv_of_slot(slot, uv01.xy, uv01.zw); }
