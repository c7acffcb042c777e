#include "renderers/scene/coarser.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ir::scene {

namespace {

/// Vertices at one place are one, whatever their normals are: meshoptimizer moves no vertex with more than
/// two copies, and triangles with corners of their own would all stay. Returns the triangles that are left.
std::vector<std::uint32_t> simplified(const World& world, std::size_t indices, std::size_t target) {
    std::vector<std::uint32_t> place(world.positions.size());
    const auto places = meshopt_generateVertexRemap(place.data(), nullptr, place.size(),
                                                    world.positions.data(), place.size(), sizeof(glm::vec3));
    std::vector<std::uint32_t> vertex_at(places), welded(indices);
    std::vector<glm::vec3> positions(places);
    for (auto i = place.size(); i-- > 0;) {
        vertex_at[place[i]] = static_cast<std::uint32_t>(i);
        positions[place[i]] = world.positions[i];
    }
    for (std::size_t i = 0; i < indices; ++i) welded[i] = place[world.indices[i]];
    // Of the scene's size: the number of triangles alone decides.
    constexpr float max_error = 1;
    std::vector<std::uint32_t> result(indices);
    result.resize(meshopt_simplify(result.data(), welded.data(), indices, &positions.front().x, places,
                                   sizeof(glm::vec3), target, max_error, 0, nullptr));
    for (auto& index : result) index = vertex_at[index];
    return result;
}

}  // namespace

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
    if (opaque > 0) result.indices = simplified(world, opaque, target);
    result.opaque_triangles = static_cast<std::uint32_t>(result.indices.size() / 3);
    result.triangle_materials.assign(result.opaque_triangles, 0);
    result.indices.insert(result.indices.end(), masked, world.indices.end());
    result.triangle_materials.insert(result.triangle_materials.end(),
                                     world.triangle_materials.begin() + world.opaque_triangles,
                                     world.triangle_materials.end());
    return result;
}

}  // namespace ir::scene
