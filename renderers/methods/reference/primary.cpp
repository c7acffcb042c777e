#include "renderers/methods/reference/primary.h"

#include "renderers/core/constants.h"
#include "renderers/methods/reference/estimate.h"

namespace ir::methods::reference {
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
    const auto key = passes::pixel_key(seed, pixel.x, pixel.y);
    PathStart centre;
    if (gbuffer_) {
        centre = through(glm::vec2(pixel) + 0.5f);
        find_surface(pixel, centre);
    }
    for (auto sample = begin; sample < end; ++sample) {
        const passes::PathSampler sampler(key + sample % randomisations,
                                          static_cast<std::uint32_t>(sample / randomisations));
        starts.push_back(gbuffer_ ? centre : through(glm::vec2(pixel) + sampler.pair(in_pixel)));
        starts.back().sampler = sampler;
    }
}

}  // namespace ir::methods::reference
