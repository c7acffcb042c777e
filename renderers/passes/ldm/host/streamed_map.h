#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderers/passes/ldm/host/meshlets.h"
#include "renderers/passes/ldm/host/node.h"
#include "renderers/passes/ldm/host/pixel_tiles.h"
#include "renderers/passes/ldm/maps.h"

namespace ir::passes {
class AlphaMasks;
}  // namespace ir::passes

namespace ir::passes::ldm {

/// What a map that lives for a moment holds of each texel.
enum class Holds {
    outermost,    ///< its outermost two depths: enough where hits at any distance count
    lists,        ///< all depths, in no order
    sloped_lists  ///< of each depth the slopes of its surface, too (shaders/passes/ldm/node.glsl)
};

/// As struct LdmRule of shaders/passes/ldm/trace.glsl.
struct SelfHitRule {
    bool tangent_plane = true;  ///< else normal-offset
    float quanta = 0, slope = 0, offset = 0, max_dip = 0;
};

/// Which hits count, and how much.
struct Visibility {
    float max_distance = 0;  ///< m; 0: hits at any distance close a direction
    bool smooth = false;     ///< V = (d/d_max)² below it, else 0
};

/// A band of rows of one map, small enough for a cache: its texels are numbered with 16 bits.
class StreamedMap {
  public:
    static constexpr int max_texels = 65536;
    /// Rows of a band, so that it has at most that many texels.
    static int band_rows(int resolution) {
        return std::max(1, std::min(resolution, max_texels / resolution));
    }

    StreamedMap(int resolution, Holds holds) : resolution(resolution), holds(holds) {}

    /// Cells of the outermost depths: level 0 are the texels, those of each other one are blocks of cells of
    /// the level before.
    static constexpr int level_count = 4, block_side = 4;
    struct Level {
        std::size_t begin = 0;
        int columns = 0, rows = 0;
        /// One vector more than there are cells.
        std::size_t end() const { return begin + static_cast<std::size_t>(columns) * rows + 16; }
    };
    static std::array<Level, level_count> levels_of(int resolution, int rows);

    const int resolution;
    const Holds holds;
    MapFrame frame{};
    int first_row = 0, rows = 0;
    std::array<Level, level_count> levels{};
    /// Of each texel the largest depth << 16 | largest of 65535 - depth; 0: no surface. Of a block the least
    /// of both.
    std::vector<std::uint32_t> outermost;
    /// Where the depths of each texel begin, and where the last one's end.
    std::vector<std::uint32_t> begins;
    std::vector<std::uint16_t> depths;
    /// Codes of both slopes of each depth, and what codes stand for.
    std::vector<std::uint16_t> slopes;
    SlopeTable slope_of{};

    /// A texel's longer side in quanta of depth.
    static float texel_quanta(const MapFrame& frame) {
        return std::max(glm::length(glm::vec3(frame.step_u)), glm::length(glm::vec3(frame.step_v))) /
               frame.direction.w;
    }

    static std::uint64_t outermost_bytes(int resolution, int rows) {
        return 4 * std::uint64_t{levels_of(resolution, rows).back().end()};
    }
    std::uint64_t bytes() const {
        return 4 * (outermost.capacity() + begins.capacity()) + 2 * (depths.capacity() + slopes.capacity());
    }
};

/// What building a map needs for a moment: one for each thread.
struct BuildScratch {
    static constexpr int queue_size = 512, lanes = 16;
    /// Triangles that may cover a texel's centre: corners in subtexels and depths in quanta; for those with
    /// alpha masks the number.
    struct Queue {
        alignas(64) float x[3][queue_size + lanes], y[3][queue_size + lanes], z[3][queue_size + lanes];
        alignas(64) std::uint32_t number[queue_size + lanes];
        int size = 0;
    } queue, others;
    std::vector<std::uint8_t> hidden;      ///< meshlets that change no outermost depth
    std::vector<std::uint32_t> line;       ///< of cells
    std::vector<std::uint32_t> fragments;  ///< texel of the band << 16 | depth
    std::vector<std::uint32_t> slopes;     ///< of fragments, codes
    std::size_t fragment_count = 0;
    std::uint64_t fragments_made = 0;  ///< since this was made
    std::uint64_t bytes() const { return sizeof(*this) + 4 * (fragments.capacity() + slopes.capacity()); }
};

/// Numbers of directions for each pixel, as PixelTiles counts them.
struct SelfHitCounts {
    std::vector<std::uint16_t> own;       ///< own entry found
    std::vector<std::uint16_t> queried;   ///< directions in which the pixel is inside of the map
    std::vector<std::uint16_t> rejected;  ///< something else may have been taken for the own entry
    void resize(std::size_t pixels);
    void add(const SelfHitCounts& other);
};

/// Sums are whole numbers, this often for V cosθ = 1: the order in which maps are added does not matter then,
/// and no sum of as many maps overflows.
float sum_scale(int maps);

/// Rasterises `rows` rows of the map of `frame`, from `first_row` on. Triangles cover the texels that the
/// compute builder has them cover; the arithmetic before snapping may be rounded differently.
void build_map(const Meshlets& meshlets, const AlphaMasks& masks, const MapFrame& frame, int first_row,
               int rows, StreamedMap& map, BuildScratch& scratch);

/// Adds Σ V cosθ of tiles first … end - 1 over the maps, which are bands of the same rows, to `sums`.
void add_visibility(const PixelTiles& tiles, std::size_t first, std::size_t end,
                    std::span<const StreamedMap> maps, const SelfHitRule& rule, const Visibility& visibility,
                    float scale, std::span<std::uint32_t> sums);

/// How far the pixels of tiles first … end - 1 see along a map, on the side of their shading normals, in
/// quanta, 64 a tile: infinite where nothing is in the way, below 0 where there is no surface, the map's
/// direction runs below it, or another band has the answer. The map holds lists.
void see_along(const PixelTiles& tiles, std::size_t first, std::size_t end, const StreamedMap& map,
               const SelfHitRule& rule, std::span<float> distances);

/// Counts what the self-hit rule did. The maps hold lists.
void count_self_hits(const PixelTiles& tiles, std::span<const StreamedMap> maps, const SelfHitRule& rule,
                     SelfHitCounts& counts);

/// Σ cosθ over all directions (unit length) of tiles first … end - 1, 64 a tile.
void sum_cosines(const PixelTiles& tiles, std::size_t first, std::size_t end,
                 std::span<const MapFrame> frames, float scale, std::span<std::uint32_t> sums);

}  // namespace ir::passes::ldm
