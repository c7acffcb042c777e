#include "renderers/passes/bounce/host/host_receivers.h"

#include <algorithm>

#include "renderers/core/half_float.h"
#include "renderers/passes/scattering/microfacets.h"

namespace ir::passes::bounce {

glm::vec3 shading_normal(glm::vec3 stored, glm::vec3 geometric_normal) {
    const float size = glm::length(stored);
    if (size < 0.5f) return geometric_normal;
    const auto n = stored / size;
    return glm::dot(n, geometric_normal) > 1 - 1e-6f ? geometric_normal : n;
}

HostReceivers::HostReceivers(const graph::PassContext& context, const Receivers& receivers)
    : scene_(*context.inputs().scene),
      constants_(receivers.constants(context.inputs())),
      model_(receivers.options.materials),
      positions_(context.pixels<const glm::vec4>(receivers.gbuffer.position)),
      geometric_normals_(context.pixels<const glm::vec4>(receivers.gbuffer.geometric_normal)),
      normals_(context.pixels<const std::uint64_t>(receivers.gbuffer.normal)) {
    if (!receivers.options.light) return;
    albedos_ = context.pixels<const std::uint64_t>(receivers.gbuffer.albedo);
    materials_ = context.pixels<const std::uint64_t>(receivers.gbuffer.material);
}

void HostReceivers::declare_reads(graph::PassBuilder& pass, const Receivers& receivers) {
    const auto& gbuffer = receivers.gbuffer;
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    if (receivers.options.light) pass.reads(gbuffer.albedo, gbuffer.material);
}

std::optional<HostReceiver> HostReceivers::at(std::size_t pixel) const {
    const glm::vec3 geometric_normal(geometric_normals_[pixel]);
    if (geometric_normal == glm::vec3(0)) return {};
    const glm::vec3 stored(unpack_halves(normals_[pixel]));
    return HostReceiver{glm::vec3(positions_[pixel]), shading_normal(stored, geometric_normal),
                        geometric_normal, stored};
}

std::optional<HostScatterer> HostReceivers::scatterer_at(std::size_t pixel,
                                                         const HostReceiver& receiver) const {
    const auto material = unpack_halves(materials_[pixel]);
    if (material.z > 0.5f) return {};
    const auto& [eye, axis] = constants_.viewer;
    HostScatterer s;
    s.colour = glm::vec3(unpack_halves(albedos_[pixel]));
    s.viewer = axis == glm::vec3(0) ? glm::normalize(eye - receiver.position) : -axis;
    s.n_dot_v = glm::dot(receiver.normal, s.viewer);
    s.metallic = material.x;
    s.roughness = std::max(material.y, constants_.min_roughness);
    s.ior = ior_of(material.w);
    s.lobes = lobes_of(s.colour, s.metallic, s.ior);
    return s;
}

HostLobes HostReceivers::lobes_of(glm::vec3 colour, float metallic, float ior) const {
    using Materials = Transport::Materials;
    if (model_ == Materials::lambert) return {colour, glm::vec3(0), 0};
    if (model_ == Materials::metalness_blend) return {(1 - metallic) * colour, colour, metallic};
    return {(1 - metallic) * colour, layered_f0(ior, colour, metallic), 1};
}

float HostReceivers::ior_of(float stored_material) const {
    const auto last = static_cast<float>(scene_.materials.size() - 1);
    return scene_.materials[static_cast<std::size_t>(std::clamp(stored_material + 0.5f, 0.0f, last))].ior;
}

}  // namespace ir::passes::bounce
