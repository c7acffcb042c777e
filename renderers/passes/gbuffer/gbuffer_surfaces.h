#pragma once

#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/surface/surface.h"

namespace ir::passes {

/// The G-buffer on the host, as surfaces from which rays start.
class GBufferSurfaces {
  public:
    /// For a pass of the cpu queue that reads position, both normals, albedo, material and emission.
    GBufferSurfaces(const graph::PassContext& context, const GBuffer& gbuffer);
    static void declare_reads(graph::PassBuilder& pass, const GBuffer& gbuffer);

    bool is_background(std::size_t pixel) const { return positions_[pixel].w == 0; }
    bool is_behind_glass(std::size_t pixel) const { return !glass_.empty() && glass_[pixel].a > 0; }
    /// Which side of the triangle it is, is not known: taken to be the front.
    Surface at(std::size_t pixel) const;

  private:
    std::span<const glm::vec4> positions_, geometric_normals_, glass_;
    std::span<const std::uint64_t> normals_, albedos_, materials_, emissions_;
    std::size_t material_count_;
};

}  // namespace ir::passes
