#pragma once

#include <vector>

#include "renderers/scene/world.h"

namespace ir::passes {

/// Consecutive triangles.
struct TriangleRun {
    std::uint32_t first = 0, count = 0;
};

/// The triangles of a world in chunks that have bounds, so that a view need not draw what lies beside it.
class TriangleChunks {
  public:
    TriangleChunks() = default;
    explicit TriangleChunks(const scene::World& world);

    /// Those of `range` that may be in the view, in their order; depths do not count.
    std::vector<TriangleRun> seen(const glm::mat4& clip_from_world, TriangleRun range) const;

  private:
    static constexpr std::uint32_t chunk = 256;  ///< triangles
    std::vector<scene::Bounds> bounds_;
};

}  // namespace ir::passes
