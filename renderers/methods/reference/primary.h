#pragma once

#include <vector>

#include "renderers/methods/reference/wavefront.h"
#include "renderers/passes/gbuffer/gbuffer_surfaces.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::reference {

/// Where paths of a pixel start: one ray for each, uniform over the pixel, or all on the surface that the
/// G-buffer has there.
class PrimaryRays {
  public:
    PrimaryRays(const scene::View& view, const passes::GBufferSurfaces* gbuffer)
        : rays_(passes::pixel_rays(view)), width_(view.width), gbuffer_(gbuffer) {}

    /// Forgets the surfaces of earlier pixels; `most` may be added then.
    void begin(std::size_t most) { surfaces_.clear(), surfaces_.reserve(most); }
    /// Appends the starts of samples [begin, end) of a pixel. Their surfaces stay until begin().
    void add(glm::ivec2 pixel, std::uint64_t seed, std::uint64_t begin, std::uint64_t end,
             std::vector<PathStart>& starts);

  private:
    PathStart through(glm::vec2 position_px) const;
    void find_surface(glm::ivec2 pixel, PathStart& start);
    passes::PixelRays rays_;
    int width_;
    const passes::GBufferSurfaces* gbuffer_;
    std::vector<passes::Surface> surfaces_;
};

}  // namespace ir::methods::reference
