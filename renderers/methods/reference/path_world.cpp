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

bool is_smooth_somewhere(const scene::Scene& scene, const scene::Material& material) {
    const float roughness =
        material.roughness * min_green(scene, material.metallic_roughness_texture.texture);
    return roughness * roughness < passes::mirror_alpha;
}

bool is_specular(const scene::Scene& scene, const scene::Material& material, Transport::Materials model) {
    if (model == Transport::Materials::lambert || material.unlit) return false;
    // Rough glass scatters; only what has the index of air lets light pass straight on.
    const bool is_clear = material.thickness > 0 && std::abs(material.ior - 1) < 2 * passes::same_index;
    if (material.transmission > 0 && is_clear) return true;
    const bool has_interface =
        model == Transport::Materials::gltf || material.metallic > 0 || material.transmission > 0;
    return has_interface && is_smooth_somewhere(scene, material);
}

}  // namespace

std::vector<bool> specular_materials(const scene::Scene& scene, Transport::Materials model) {
    std::vector<bool> result;
    for (const auto& material : scene.materials) result.push_back(is_specular(scene, material, model));
    return result;
}

PathWorld::PathWorld(const passes::Bvh& b, const passes::SurfaceLookup& s, const PathLights& l,
                     std::vector<bool> specular)
    : bvh(b), surfaces(s), lights(l), may_be_specular(std::move(specular)) {
    for (const auto& m : s.scene().materials) emits.push_back(m.emission != glm::vec3(0));
}

}  // namespace ir::methods::reference
