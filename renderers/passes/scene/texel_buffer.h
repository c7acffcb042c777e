#pragma once

#include <cstdint>
#include <vector>

#include "renderers/graph/builder.h"
#include "renderers/scene/scene.h"

namespace ir::passes {

/// How textures lie in "scene.texels", one array of words that shaders/passes/scene/texels.glsl reads: 256
/// floats that decode sRGB, 4 words for each texture of the scene, then RGBA8 texels, row 0 first.
struct TexelLayout {
    struct Entry {
        std::uint32_t first_word = 0;
        int width = 0, height = 0;  ///< 0: no surface reads the texture
        int halvings = 0;           ///< of the sides of the scene's texture
    };
    std::vector<Entry> textures;  ///< as many as Scene::textures
    std::uint64_t words = 0;
    int reduced = 0;  ///< how many textures were made smaller
    int side = 0;     ///< that no side exceeds
};

/// No side is longer, in texels: scattered light is seen blurred.
constexpr int max_texels_a_side = 1024;
/// Textures are halved further until all of them take no more.
constexpr std::uint64_t max_texel_bytes = std::uint64_t{256} << 20;

/// Base colour, metallic-roughness, normal, emission and transmission textures of the scene's materials.
TexelLayout texel_layout(const scene::Scene& scene, std::uint64_t max_bytes = max_texel_bytes,
                         int max_side = max_texels_a_side);
/// Reduced textures are averages of equal areas, of decoded values where they are sRGB-encoded.
std::vector<std::uint32_t> texel_words(const scene::Scene& scene, const TexelLayout& layout);

/// Declares "scene.texels" and the pass "upload texels": rays that hit anything need textures without a
/// binding for each. Kept while the scene stays the same. A note says when textures were reduced.
graph::BufferRef texel_buffer(graph::GraphBuilder& builder);

}  // namespace ir::passes
