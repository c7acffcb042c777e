#pragma once

#include <vector>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/reference/wavefront.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::methods::reference {

/// The G-buffer on the host, as surfaces where paths start.
class GBufferSurfaces {
  public:
    /// For a pass of the cpu queue that reads position, both normals, albedo, material and emission.
    GBufferSurfaces(const graph::PassContext& context, const passes::GBuffer& gbuffer);
    static void declare_reads(graph::PassBuilder& pass, const passes::GBuffer& gbuffer);

    bool is_background(std::size_t pixel) const { return positions_[pixel].w == 0; }
    bool is_behind_glass(std::size_t pixel) const { return !glass_.empty() && glass_[pixel].a > 0; }
    /// Which side of the triangle it is, is not known: taken to be the front.
    passes::Surface at(std::size_t pixel) const;

  private:
    std::span<const glm::vec4> positions_, geometric_normals_, glass_;
    std::span<const std::uint64_t> normals_, albedos_, materials_, emissions_;
    std::size_t material_count_;
};

/// Where paths of a pixel start: one ray for each, uniform over the pixel, or all on the surface that the
/// G-buffer has there.
class PrimaryRays {
  public:
    PrimaryRays(const scene::View& view, const PathWorld& world, const GBufferSurfaces* gbuffer)
        : rays_(passes::pixel_rays(view)), width_(view.width), world_(world), gbuffer_(gbuffer) {}

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
    const PathWorld& world_;
    const GBufferSurfaces* gbuffer_;
    std::vector<passes::Surface> surfaces_;
};

}  // namespace ir::methods::reference
