#include "renderers/methods/reference/primary.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "renderers/core/constants.h"
#include "renderers/methods/reference/estimate.h"

namespace ir::methods::reference {
namespace {

/// Of a half float, which is exact only up to gbuffer_materials; never out of bounds, whatever it holds.
int material_index(float stored, std::size_t materials) {
    const float last = materials > 0 ? static_cast<float>(materials - 1) : 0;
    return static_cast<int>(std::min(std::max(0.0f, stored + 0.5f), last));
}

}  // namespace

GBufferSurfaces::GBufferSurfaces(const graph::PassContext& context, const passes::GBuffer& gbuffer)
    : positions_(context.pixels<glm::vec4>(gbuffer.position)),
      geometric_normals_(context.pixels<glm::vec4>(gbuffer.geometric_normal)),
      normals_(context.pixels<std::uint64_t>(gbuffer.normal)),
      albedos_(context.pixels<std::uint64_t>(gbuffer.albedo)),
      materials_(context.pixels<std::uint64_t>(gbuffer.material)),
      emissions_(context.pixels<std::uint64_t>(gbuffer.emission)),
      material_count_(context.inputs().scene->materials.size()) {
    if (gbuffer.glass) glass_ = context.pixels<glm::vec4>(*gbuffer.glass);
}

void GBufferSurfaces::declare_reads(graph::PassBuilder& pass, const passes::GBuffer& gbuffer) {
    pass.reads(gbuffer.position, gbuffer.geometric_normal, gbuffer.normal, gbuffer.albedo, gbuffer.material,
               gbuffer.emission);
    if (gbuffer.glass) pass.reads(*gbuffer.glass);
}

passes::Surface GBufferSurfaces::at(std::size_t i) const {
    const auto albedo = glm::unpackHalf4x16(albedos_[i]), material = glm::unpackHalf4x16(materials_[i]);
    const auto normal = glm::vec3(glm::unpackHalf4x16(normals_[i]));
    passes::Surface s;
    s.position_ws = glm::vec3(positions_[i]);
    s.geometric_normal_ws = glm::normalize(glm::vec3(geometric_normals_[i]));
    const float length = glm::length(normal);  // half floats: not quite 1
    s.shading_normal_ws = length > 0.5f ? normal / length : s.geometric_normal_ws;
    s.base_colour = glm::vec3(albedo);
    s.transmission = albedo.a;
    s.metallic = material.x, s.roughness = material.y;
    s.is_unlit = material.z > 0.5f;
    s.material = material_index(material.w, material_count_);
    s.emission = glm::vec3(glm::unpackHalf4x16(emissions_[i]));
    return s;
}

PathStart PrimaryRays::through(glm::vec2 at) const {
    PathStart start;
    start.origin_ws = rays_.origin + at.x * rays_.origin_dx + at.y * rays_.origin_dy;
    start.direction_ws =
        glm::normalize(rays_.direction + at.x * rays_.direction_dx + at.y * rays_.direction_dy);
    return start;
}

void PrimaryRays::find_surface(glm::ivec2 pixel, PathStart& start) {
    const auto i = static_cast<std::size_t>(pixel.y) * width_ + pixel.x;
    if (gbuffer_->is_behind_glass(i)) return;
    start.is_known = true;
    start.distance = infinity;
    if (gbuffer_->is_background(i)) return;
    surfaces_.push_back(gbuffer_->at(i));
    auto& surface = surfaces_.back();
    // What is glass in part needs to know whether light comes in or goes out there.
    start.is_known = surface.transmission == 0;
    start.surface = &surface;
    // The rasterised position lies on the pixel's ray but for rounding; from the eye it is exact.
    start.distance = glm::distance(surface.position_ws, start.origin_ws);
}

void PrimaryRays::add(glm::ivec2 pixel, std::uint64_t seed, std::uint64_t begin, std::uint64_t end,
                      std::vector<PathStart>& starts) {
    const auto key = pixel_key(seed, pixel.x, pixel.y);
    PathStart centre;
    if (gbuffer_) {
        centre = through(glm::vec2(pixel) + 0.5f);
        find_surface(pixel, centre);
    }
    for (auto sample = begin; sample < end; ++sample) {
        const PathSampler sampler(key + sample % randomisations,
                                  static_cast<std::uint32_t>(sample / randomisations));
        starts.push_back(gbuffer_ ? centre : through(glm::vec2(pixel) + sampler.pair(in_pixel)));
        starts.back().sampler = sampler;
    }
}

}  // namespace ir::methods::reference
