#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderers/scene/scene.h"

namespace ir::scene {

/// Consecutive triangles of one material.
struct MaterialRange {
    int material = 0;
    std::uint32_t first_triangle = 0, triangle_count = 0;
};

/// One texel in one bit: whether a surface with an alpha mask is there. G-buffer, shadow maps, layered depth
/// maps and ray tracing all query this one bitmap at the nearest texel, so that they agree about holes.
struct OpacityBitmap {
    int material = -1;
    int width = 0, height = 0;
    std::uint32_t first_word = 0;  ///< into World::opacity_words; rows are padded to 32 texels
};

/// A scene at one time, flattened to world space: one triangle soup with vertices in arrays of equal length,
/// opaque triangles first, then those with alpha masks, each sorted by material. Mirrored instances keep
/// their winding's geometric meaning (normals are transformed by the inverse transpose). Zero-area triangles
/// are kept.
struct World {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uv0, uv1;
    std::vector<std::uint32_t> colours;  ///< RGBA8 UNORM, linear, R in the low byte; 0xffffffff where none
    /// Previous position = position + to_previous. Empty: all stand still.
    std::vector<glm::vec3> to_previous;
    std::vector<std::uint32_t> indices;  ///< three per triangle
    std::vector<std::uint32_t> triangle_materials;
    std::vector<MaterialRange> ranges;
    std::uint32_t opaque_triangles = 0;  ///< triangles before this one have no alpha mask
    std::vector<OpacityBitmap> opacity;  ///< one per masked material
    std::vector<std::uint32_t> opacity_words;
    Bounds bounds;              ///< of all vertices of triangles
    std::vector<Light> lights;  ///< resolved to world space
    bool lights_moved = false;  ///< whoever moves lights says whether they are others than a frame before
    std::vector<Camera> cameras;
    std::size_t triangles() const { return indices.size() / 3; }
};

/// `time` and `previous_time` in seconds.
World flatten(const Scene& scene, double time, double previous_time);

/// What its arrays take on the host.
std::size_t memory_bytes(const World& world);

/// Triangles whose material shines.
std::size_t emissive_triangles(const Scene& scene, const World& world);

/// uv after the slot's transform.
glm::vec2 transformed_uv(const TextureSlot& slot, glm::vec2 uv);

/// Whether the masked surface is present at these (transformed) base-colour coordinates.
bool is_covered(const World& world, const OpacityBitmap& bitmap, const Sampler& sampler, glm::vec2 uv);

}  // namespace ir::scene
