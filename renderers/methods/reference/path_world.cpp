#include "renderers/methods/reference/path_world.h"

#include <algorithm>
#include <cmath>

#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::reference {

namespace {

/// The smallest value of the texture's green channel, which is roughness; 1 without a texture.
float min_green(const scene::Scene& scene, int texture) {
    if (texture < 0) return 1;
    std::uint8_t least = 255;
    const auto& rgba = scene.textures[static_cast<std::size_t>(texture)].rgba;
    for (std::size_t i = 1; i < rgba.size() && least > 0; i += 4) least = std::min(least, rgba[i]);
    return static_cast<float>(least) / 255;
}

/// The smallest roughness².
float min_alpha(const scene::Scene& scene, const scene::Material& material) {
    const float roughness =
        material.roughness * min_green(scene, material.metallic_roughness_texture.texture);
    return roughness * roughness;
}

bool has_interface(const scene::Material& material, Transport::Materials model) {
    if (model == Transport::Materials::lambert || material.unlit) return false;
    return model == Transport::Materials::gltf || material.metallic > 0 || material.transmission > 0;
}

/// Rough glass scatters; only what has the index of air lets light pass straight on.
bool is_clear(const scene::Material& material) {
    return material.transmission > 0 && material.thickness > 0 &&
           std::abs(material.ior - 1) < 2 * passes::same_index;
}

}  // namespace

SharpMaterials sharp_materials(const scene::Scene& scene, Transport::Materials model) {
    SharpMaterials result;
    for (const auto& material : scene.materials) {
        const bool reflects = has_interface(material, model);
        const float alpha = reflects ? min_alpha(scene, material) : 1;
        const bool has_specular = reflects && (is_clear(material) || alpha < passes::mirror_alpha);
        result.specular.push_back(has_specular);
        result.sharp.push_back(has_specular || (reflects && alpha < sharp_alpha));
    }
    return result;
}

PathWorld::PathWorld(const passes::Bvh& b, const passes::SurfaceLookup& s, const PathLights& l,
                     SharpMaterials materials)
    : bvh(b), surfaces(s), lights(l), may_be(std::move(materials)) {
    for (const auto& m : s.scene().materials) emits.push_back(m.emission != glm::vec3(0));
}

}  // namespace ir::methods::reference
