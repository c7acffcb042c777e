#include "renderers/scene/coarser.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ir::scene {

World coarser(const World& world, float detail) {
    World result;
    result.positions = world.positions;
    result.uv0 = world.uv0;
    result.uv1 = world.uv1;
    result.opacity = world.opacity;
    result.opacity_words = world.opacity_words;
    result.bounds = world.bounds;
    const std::size_t opaque = 3 * std::size_t{world.opaque_triangles};
    const auto masked = world.indices.begin() + static_cast<std::ptrdiff_t>(opaque);
    const auto target =
        3 * static_cast<std::size_t>(std::lround(detail * static_cast<float>(world.opaque_triangles)));
    result.indices.assign(world.indices.begin(), masked);
    if (opaque > 0) {
        // Of the scene's size: the number of triangles alone decides.
        constexpr float max_error = 1;
        const auto kept =
            meshopt_simplify(result.indices.data(), world.indices.data(), opaque, &world.positions.front().x,
                             world.positions.size(), sizeof(glm::vec3), target, max_error, 0, nullptr);
        result.indices.resize(kept);
    }
    result.opaque_triangles = static_cast<std::uint32_t>(result.indices.size() / 3);
    result.triangle_materials.assign(result.opaque_triangles, 0);
    result.indices.insert(result.indices.end(), masked, world.indices.end());
    result.triangle_materials.insert(result.triangle_materials.end(),
                                     world.triangle_materials.begin() + world.opaque_triangles,
                                     world.triangle_materials.end());
    return result;
}

}  // namespace ir::scene
