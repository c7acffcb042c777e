#include "renderers/passes/direct/panes.h"

#include <algorithm>

#include "renderers/passes/raytracing/ray_offset.h"
#include "renderers/passes/scattering/bsdf.h"

namespace ir::passes {

Panes::Panes(const Bvh& bvh, const SurfaceLookup& surfaces, Transport::Materials model)
    : bvh_(bvh), surfaces_(surfaces), model_(model), any_(any_in(surfaces.materials(), model)) {}

bool Panes::may_be(const scene::Material& material) {
    return material.transmission > 0 && material.thickness <= 0;
}

bool Panes::any_in(std::span<const scene::Material> materials, Transport::Materials model) {
    return model != Transport::Materials::lambert && std::ranges::any_of(materials, may_be);
}

glm::vec3 Panes::Sight::passed(float distance) const {
    glm::vec3 product(1);
    for (std::size_t i = 0; i < count_ && panes_[i].distance < distance; ++i) product *= panes_[i].passed;
    return product;
}

Panes::Sight Panes::look(glm::vec3 origin, glm::vec3 direction, float far) const {
    Sight sight;
    float travelled = 0;
    for (;;) {
        sight.end = bvh_.closest_hit(origin, direction, 0, far - travelled);
        if (!sight.end.is_hit()) return sight;
        sight.end.distance += travelled;
        if (!any_ || sight.count_ == sight.panes_.size()) return sight;
        const auto surface = surfaces_.at(sight.end, direction);
        const auto part = passed(surface, direction);
        if (part == glm::vec3(0)) return sight;
        sight.panes_[sight.count_++] = {sight.end.distance, part};
        travelled = sight.end.distance;
        origin = offset_origin(surface.position_ws, -surface.geometric_normal_ws);
    }
}

glm::vec3 Panes::passed(const Surface& surface, glm::vec3 direction) const {
    if (surface.emission != glm::vec3(0)) return glm::vec3(0);  // the source itself
    return Bsdf(surface, surfaces_.material(surface.material), model_).passed_straight(-direction);
}

}  // namespace ir::passes
