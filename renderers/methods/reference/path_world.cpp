#include "renderers/methods/reference/path_world.h"

#include <algorithm>

#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::reference {

bool may_be_specular(const scene::Material& material, Transport::Materials model) {
    if (model == Transport::Materials::lambert || material.unlit) return false;
    const bool is_smooth = material.metallic_roughness_texture.texture >= 0 ||
                           material.roughness * material.roughness < passes::mirror_alpha;
    const bool has_interface = model == Transport::Materials::gltf || material.metallic > 0;
    return material.transmission > 0 || (is_smooth && has_interface);
}

PathWorld::PathWorld(const passes::Bvh& b, const passes::SurfaceLookup& s, const passes::LightSampler& l,
                     Transport::Materials model)
    : bvh(b), surfaces(s), lights(l), rays_meet_lights(l.has_environment()) {
    for (const auto& m : s.scene().materials) {
        emits.push_back(m.emission != glm::vec3(0));
        may_be_specular.push_back(reference::may_be_specular(m, model));
        rays_meet_lights = rays_meet_lights || emits.back();
    }
    const auto& all = s.world().lights;
    rays_meet_lights =
        rays_meet_lights || std::any_of(all.begin(), all.end(), [](const scene::Light& light) {
            return light.type == scene::LightType::rectangle || light.type == scene::LightType::disk;
        });
}

}  // namespace ir::methods::reference
