#include "renderers/methods/ldm-indirect/gloss/hit_light.h"
#include "renderers/passes/lights/punctual.h"
#include "renderers/passes/raytracing/ray_offset.h"

namespace ir::methods::ldm_indirect {

HitLight::HitLight(const graph::FrameInputs& inputs, const passes::Bvh& bvh,
                   const passes::SurfaceLookup& surfaces, const passes::ExtendedEmitters* sources,
                   const passes::ExtendedLightOptions& options)
    : bvh_(bvh), panes_(bvh, surfaces, options.materials) {
    for (const auto& light : inputs.world->lights)
        if (passes::is_punctual(light)) punctual_.push_back(light);
    if (sources)
        extended_.emplace(
            bvh, sources->surfaces, sources->lights,
            passes::LightEstimate::Options{
                .materials = options.materials, .between = options.materials, .mirrors = options.mirrors});
}

glm::vec3 HitLight::arriving(glm::vec3 origin, glm::vec3 direction, float far) const {
    if (!panes_.any()) return glm::vec3(bvh_.occluded(origin, direction, 0, far) ? 0 : 1);
    const auto sight = panes_.look(origin, direction, far);
    return sight.end.is_hit() ? glm::vec3(0) : sight.passed(far);
}

glm::vec3 HitLight::of_punctual(const passes::Surface& surface, const passes::Bsdf& bsdf,
                                glm::vec3 wo) const {
    const auto origin = passes::offset_origin(surface.position_ws, surface.geometric_normal_ws);
    glm::vec3 sum(0);
    for (const auto& light : punctual_) {
        const auto arrival = passes::punctual_arrival(light, surface.position_ws);
        if (!arrival || glm::dot(surface.geometric_normal_ws, arrival->direction_ws) <= 0) continue;
        const auto radiance = bsdf.evaluate(wo, arrival->direction_ws) * arrival->irradiance;
        if (radiance == glm::vec3(0)) continue;
        sum += radiance * arriving(origin, arrival->direction_ws, arrival->distance * passes::shadow_ray_end);
    }
    return sum;
}

glm::vec3 HitLight::reflected(const passes::Surface& surface, const passes::Bsdf& bsdf, glm::vec3 wo,
                              const passes::PathSampler& sampler) const {
    auto light = of_punctual(surface, bsdf, wo);
    if (extended_) light += extended_->sample(surface, wo, sampler);
    return light;
}

}  // namespace ir::methods::ldm_indirect
