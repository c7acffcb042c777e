#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "renderers/methods/ldm-indirect/splatting/host/add_kernels.h"

namespace ir::methods::ldm_indirect {
namespace {

/// A box from parts of it.
struct Extent {
    float least = std::numeric_limits<float>::max(), most = -std::numeric_limits<float>::max();
    void add(float centre, float half) {
        least = std::min(least, centre - half);
        most = std::max(most, centre + half);
    }
};

}  // namespace

void SurfaceBoxes::resize(std::size_t count) {
    constexpr float empty = -1e30f;
    for (auto* axes : {&position, &normal})
        for (auto& axis : *axes) {
            axis.centre.assign(count, 0.0f);
            axis.half.assign(count, axes == &position ? empty : 0.0f);
        }
}

TileGroups group_tiles(const PixelTiles& tiles) {
    TileGroups result;
    const int side = TileGroups::side;
    const int tile_rows = static_cast<int>(tiles.count()) / tiles.columns;
    result.columns = (tiles.columns + side - 1) / side;
    result.rows = (tile_rows + side - 1) / side;
    const auto padded = (result.count() + TileGroups::tiles - 1) / TileGroups::tiles * TileGroups::tiles;
    result.groups.resize(padded);
    result.members.resize(result.count() * TileGroups::tiles);
    result.places.assign(result.count() * TileGroups::tiles, -1);
    const auto set = [](SurfaceBoxes::Axis& axis, std::size_t at, const Extent& extent) {
        axis.centre[at] = 0.5f * (extent.least + extent.most);
        axis.half[at] = 0.5f * (extent.most - extent.least);
    };
    for (std::size_t group = 0; group < result.count(); ++group) {
        Extent positions[3], normals[3];
        bool holds_any = false;
        for (int i = 0; i < TileGroups::tiles; ++i) {
            const int column = static_cast<int>(group) % result.columns * side + i % side;
            const int row = static_cast<int>(group) / result.columns * side + i / side;
            if (column >= tiles.columns || row >= tile_rows) continue;
            const auto tile = static_cast<std::size_t>(row) * tiles.columns + column;
            if (tiles.valid[tile] == 0) continue;
            const auto member = group * TileGroups::tiles + static_cast<std::size_t>(i);
            result.places[member] = static_cast<std::int32_t>(tile);
            holds_any = true;
            for (int axis = 0; axis < 3; ++axis) {
                const auto copy = [&](SurfaceBoxes::Axis& to, const PixelTiles::Boxes& from, Extent& whole) {
                    to.centre[member] = from.centre[axis][tile];
                    to.half[member] = from.half[axis][tile];
                    whole.add(to.centre[member], to.half[member]);
                };
                copy(result.members.position[axis], tiles.position_boxes, positions[axis]);
                copy(result.members.normal[axis], tiles.geometric_normal_boxes, normals[axis]);
            }
        }
        if (!holds_any) continue;
        for (int axis = 0; axis < 3; ++axis) {
            set(result.groups.position[axis], group, positions[axis]);
            set(result.groups.normal[axis], group, normals[axis]);
        }
    }
    return result;
}

void BoxLooks::resize(std::size_t maps, std::size_t count) {
    boxes = count;
    shortest.assign(maps * count, 255);
    longest.assign(maps * count, 0);
}

void BoxLooks::add(std::size_t map, std::size_t box, std::uint8_t shorter, std::uint8_t longer) {
    auto &least = shortest[map * boxes + box], &most = longest[map * boxes + box];
    least = std::min(least, shorter);
    most = std::max(most, longer);
}

void find_ranges(const PixelTiles& tiles, const TileGroups& groups, TileLooks& looks) {
    looks.of_groups.resize(looks.maps, groups.groups.position[0].centre.size());
    looks.of_members.resize(looks.maps, groups.places.size());
    tbb::parallel_for(std::size_t{0}, looks.maps, [&](std::size_t map) {
        for (std::size_t member = 0; member < groups.places.size(); ++member) {
            if (groups.places[member] < 0) continue;
            const auto tile = static_cast<std::size_t>(groups.places[member]);
            const auto* const of = looks.of(tile, map);
            std::uint8_t shortest = 255, longest = 0;
            for (int i = 0; i < PixelTiles::pixels; ++i) {
                const bool is_there = (tiles.valid[tile] >> i & 1) != 0;
                shortest = std::min<std::uint8_t>(shortest, is_there ? of[i] : 255);
                longest = std::max<std::uint8_t>(longest, is_there ? of[i] : 0);
            }
            looks.of_members.add(map, member, shortest, longest);
            looks.of_groups.add(map, member / TileGroups::tiles, shortest, longest);
        }
    });
}

}  // namespace ir::methods::ldm_indirect
