#include "renderers/passes/gbuffer/gbuffer_surfaces.h"

#include <algorithm>

#include "renderers/core/half_float.h"

namespace ir::passes {
namespace {

/// Of a half float, which is exact only up to gbuffer_materials; never out of bounds, whatever it holds.
int material_index(float stored, std::size_t materials) {
    const float last = materials > 0 ? static_cast<float>(materials - 1) : 0;
    return static_cast<int>(std::min(std::max(0.0f, stored + 0.5f), last));
}

}  // namespace

GBufferSurfaces::GBufferSurfaces(const graph::PassContext& context, const GBuffer& gbuffer)
    : positions_(context.pixels<glm::vec4>(gbuffer.position)),
      geometric_normals_(context.pixels<glm::vec4>(gbuffer.geometric_normal)),
      normals_(context.pixels<std::uint64_t>(gbuffer.normal)),
      albedos_(context.pixels<std::uint64_t>(gbuffer.albedo)),
      materials_(context.pixels<std::uint64_t>(gbuffer.material)),
      emissions_(context.pixels<std::uint64_t>(gbuffer.emission)),
      material_count_(context.inputs().scene->materials.size()) {
    if (gbuffer.glass) glass_ = context.pixels<glm::vec4>(*gbuffer.glass);
}

void GBufferSurfaces::declare_reads(graph::PassBuilder& pass, const GBuffer& gbuffer) {
    pass.reads(gbuffer.position, gbuffer.geometric_normal, gbuffer.normal, gbuffer.albedo, gbuffer.material,
               gbuffer.emission);
    if (gbuffer.glass) pass.reads(*gbuffer.glass);
}

Surface GBufferSurfaces::at(std::size_t i) const {
    const auto albedo = unpack_halves(albedos_[i]), material = unpack_halves(materials_[i]);
    const auto normal = glm::vec3(unpack_halves(normals_[i]));
    Surface s;
    s.position_ws = glm::vec3(positions_[i]);
    s.geometric_normal_ws = glm::normalize(glm::vec3(geometric_normals_[i]));
    const float length = glm::length(normal);  // half floats: not quite 1
    s.shading_normal_ws = length > 0.5f ? normal / length : s.geometric_normal_ws;
    s.base_colour = glm::vec3(albedo);
    s.transmission = albedo.a;
    s.metallic = material.x, s.roughness = material.y;
    s.is_unlit = material.z > 0.5f;
    s.material = material_index(material.w, material_count_);
    s.emission = glm::vec3(unpack_halves(emissions_[i]));
    return s;
}

}  // namespace ir::passes
