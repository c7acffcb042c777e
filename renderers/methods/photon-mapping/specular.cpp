#include "renderers/methods/photon-mapping/specular.h"

#include <algorithm>

#include "renderers/passes/scattering/microfacets.h"

namespace ir::methods::photon_mapping {
namespace {

/// After eight events glass still holds 5 % of the light that it sends on, of the Stanford bunny, for
/// instance.
constexpr int through_glass = 16, by_mirrors = 4;

int events_at(const scene::Material& material, Transport::Materials model) {
    if (model == Transport::Materials::lambert || material.unlit) return 0;
    if (material.transmission > 0) return through_glass;
    const bool has_interface = model == Transport::Materials::gltf || material.metallic > 0;
    return has_interface && material.roughness * material.roughness < passes::mirror_alpha ? by_mirrors : 0;
}

}  // namespace

int max_specular_events(const scene::Scene& scene, Transport::Materials model) {
    int most = 0;
    for (const auto& material : scene.materials) most = std::max(most, events_at(material, model));
    return most;
}

}  // namespace ir::methods::photon_mapping
