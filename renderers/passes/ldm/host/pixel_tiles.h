#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderers/core/uninitialised.h"

namespace ir::passes::ldm {

/// What the maps are queried for: the visible surfaces in tiles of 8x8 pixels, whose values stand together.
struct PixelTiles {
    static constexpr int side = 8, pixels = side * side;
    int width = 0, height = 0, columns = 0;
    std::vector<std::uint64_t> valid;  ///< by tile: bit 8·y + x is set where the pixel shows a surface
    using Values = std::vector<float, Uninitialised<float>>;
    /// By axis, 64 values a tile: world-space position (m), unit geometric normal, unit shading normal. 0
    /// where there is no surface.
    Values position[3], geometric_normal[3], normal[3];
    /// Boxes of what a tile's pixels hold: centre and half extent by axis, padded to a whole number of
    /// vectors.
    struct Boxes {
        std::vector<float> centre[3], half[3];
        /// Whether all vectors in it are the same.
        bool is_point(std::size_t tile) const {
            return half[0][tile] == 0 && half[1][tile] == 0 && half[2][tile] == 0;
        }
    };
    Boxes position_boxes, geometric_normal_boxes, normal_boxes;
    /// By tile, padded likewise: the plane n · x = offset through its pixels, and how far the farthest of
    /// them is from it, m; infinite where geometric normals differ or a pixel shows no surface.
    std::vector<float> plane_offset, off_plane;

    std::size_t count() const { return valid.size(); }
    /// Where pixel (x, y) stands among all of the tiles.
    std::size_t place(int x, int y) const {
        const auto tile = static_cast<std::size_t>(y / side) * columns + x / side;
        return tile * pixels + static_cast<std::size_t>(y % side * side + x % side);
    }
    /// Column and row of a tile's first pixel.
    glm::ivec2 corner(std::size_t tile) const {
        return {static_cast<int>(tile % columns) * side, static_cast<int>(tile / columns) * side};
    }
    std::uint64_t bytes() const { return count() * (pixels * 9 * sizeof(float) + 20 * sizeof(float) + 8); }
};

/// Images of a G-buffer: rows of xyzw, the shading normal in half floats; a geometric normal of 0 is
/// background.
struct SurfaceImages {
    int width = 0, height = 0;
    std::span<const glm::vec4> position;
    std::span<const std::uint64_t> normal;
    std::span<const glm::vec4> geometric_normal;
};

/// Replaces what the tiles hold, whose memory serves again. Call within the arena whose threads it may use.
void fill_pixel_tiles(PixelTiles& tiles, const SurfaceImages& images);

}  // namespace ir::passes::ldm
