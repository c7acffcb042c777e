#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderers/methods/ldm-indirect/looks.h"
#include "renderers/methods/ldm-indirect/splatting/host/kernels.h"
#include "renderers/passes/ldm/host/pixel_tiles.h"

namespace ir::methods::ldm_indirect {

using passes::ldm::PixelTiles;

/// Boxes around places (m) and around normals: centre and half extent by axis. Those that hold nothing have
/// half extents below zero, so that no kernel reaches them.
struct SurfaceBoxes {
    struct Axis {
        std::vector<float> centre, half;
    };
    Axis position[3], normal[3];
    void resize(std::size_t count);
};

/// Squares of 4x4 tiles of pixels, row by row: what a kernel is asked about at once.
struct TileGroups {
    static constexpr int side = 4, tiles = side * side;
    int columns = 0, rows = 0;
    SurfaceBoxes groups;               ///< padded to a whole number of times `tiles`
    SurfaceBoxes members;              ///< of the tiles, group by group
    std::vector<std::int32_t> places;  ///< of the members among PixelTiles; -1: beside the picture
    std::size_t count() const { return static_cast<std::size_t>(columns) * rows; }
};
TileGroups group_tiles(const PixelTiles& tiles);

/// Sums of each pixel, as PixelTiles counts them: RGB irradiance, W/m², kernels that added to it, and the sum
/// of directions.
struct TileSums {
    static constexpr int channels = 7;
    std::vector<float> channel[channels];
};

/// Of boxes the shortest and the longest look.
struct LookRanges {
    const std::uint8_t *shortest = nullptr, *longest = nullptr;
};

/// By map, then by box, as SurfaceBoxes has them.
struct BoxLooks {
    std::size_t boxes = 0;
    std::vector<std::uint8_t> shortest, longest;
    void resize(std::size_t maps, std::size_t count);
    void add(std::size_t map, std::size_t box, std::uint8_t shorter, std::uint8_t longer);
    /// From a box on.
    LookRanges at(std::size_t map, std::size_t box) const {
        return {shortest.data() + map * boxes + box, longest.data() + map * boxes + box};
    }
};

/// By tile, then by map: 64 looks of the tile's pixels. Empty: no kernel is a beam.
struct TileLooks {
    std::size_t maps = 0;
    float units_per_metre = 0;
    std::span<const std::uint8_t> looks;
    BoxLooks of_groups, of_members;  ///< of pixels that show a surface
    const std::uint8_t* of(std::size_t tile, std::size_t map) const {
        return looks.data() + look_place(tile, maps, map);
    }
};
/// Finds those of groups and members.
void find_ranges(const PixelTiles& tiles, const TileGroups& groups, TileLooks& looks);

/// Kernels that are added at once: 64 to a word.
struct KernelRound {
    static constexpr std::size_t kernels = 8192, word = 64;
    std::vector<HostKernel> made;
    /// By word, then by group: kernels that may light pixels of the group.
    std::vector<std::uint64_t> reaching;
};

/// Writes the `reaching` of one word of kernels.
void find_groups(const TileGroups& groups, const TileLooks& looks, KernelRound& round, std::size_t word);

/// Adds kernels of the round to the pixels of one group, in an order that threads do not change.
void add_to_group(const PixelTiles& tiles, const TileGroups& groups, const TileLooks& looks,
                  const KernelRound& round, std::size_t group, TileSums& sums);

}  // namespace ir::methods::ldm_indirect
