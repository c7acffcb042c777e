#include "renderers/passes/scene/material_data.h"

#include <cmath>

#include "renderers/core/record.h"

namespace ir::passes {
namespace {

TextureSlotData slot_data(const scene::TextureSlot& slot) {
    return {slot.offset,  slot.scale, std::sin(slot.rotation), std::cos(slot.rotation),
            slot.texture, slot.uv_set};
}

MaterialData data_of(const scene::Material& m) {
    MaterialData data{};
    data.base_colour = m.base_colour;
    data.emission = m.emission;
    data.metallic = m.metallic;
    data.roughness = m.roughness;
    data.normal_scale = m.normal_scale;
    data.alpha_cutoff = m.alpha_cutoff;
    data.ior = m.ior;
    data.transmission = m.transmission;
    data.thickness = m.thickness;
    data.attenuation_distance = m.attenuation_distance;
    data.flags = (m.unlit ? material_unlit : 0) | (m.double_sided ? material_double_sided : 0) |
                 (m.alpha_mode == scene::AlphaMode::mask ? material_masked : 0);
    data.attenuation_colour = m.attenuation_colour;
    data.base_colour_slot = slot_data(m.base_colour_texture);
    data.metallic_roughness_slot = slot_data(m.metallic_roughness_texture);
    data.normal_slot = slot_data(m.normal_texture);
    data.emission_slot = slot_data(m.emission_texture);
    data.transmission_slot = slot_data(m.transmission_texture);
    return data;
}

}  // namespace

std::vector<MaterialData> material_data(const scene::Scene& scene) {
    std::vector<MaterialData> data;
    data.reserve(scene.materials.size());
    for (const auto& material : scene.materials) data.push_back(data_of(material));
    return data;
}

std::vector<OpacityData> opacity_data(const scene::Scene& scene, const scene::World& world) {
    std::vector<OpacityData> data(scene.materials.size(), OpacityData{});
    for (const auto& bitmap : world.opacity) {
        const auto index = static_cast<std::size_t>(bitmap.material);
        const int texture = scene.materials.at(index).base_colour_texture.texture;
        const auto sampler =
            texture >= 0 ? scene.textures.at(static_cast<std::size_t>(texture)).sampler : scene::Sampler{};
        data[index] = {
            bitmap.width, bitmap.height, bitmap.first_word,
            static_cast<std::uint32_t>(sampler.wrap_s) | (static_cast<std::uint32_t>(sampler.wrap_t) << 4)};
    }
    return data;
}

}  // namespace ir::passes
