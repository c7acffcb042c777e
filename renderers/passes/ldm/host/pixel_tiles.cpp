#include "renderers/passes/ldm/host/pixel_tiles.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <limits>

namespace ir::passes::ldm {
namespace {

struct Images {
    std::span<const glm::vec4> position;
    std::span<const std::uint64_t> normal;
    std::span<const glm::vec4> geometric_normal;
};

struct Extent {
    glm::vec3 least{std::numeric_limits<float>::max()}, most{-std::numeric_limits<float>::max()};
    void add(const glm::vec3& value) {
        least = glm::min(least, value);
        most = glm::max(most, value);
    }
    void store(PixelTiles::Boxes& boxes, std::size_t tile) const {
        for (int axis = 0; axis < 3; ++axis) {
            boxes.centre[axis][tile] = 0.5f * (least[axis] + most[axis]);
            boxes.half[axis][tile] = 0.5f * (most[axis] - least[axis]);
        }
    }
};

void find_plane(PixelTiles& tiles, std::size_t tile) {
    constexpr auto whole = ~std::uint64_t{0};
    if (tiles.valid[tile] != whole || !tiles.geometric_normal_boxes.is_point(tile)) return;
    const auto first = tile * PixelTiles::pixels;
    float least = std::numeric_limits<float>::max(), most = -least;
    for (auto place = first; place < first + PixelTiles::pixels; ++place) {
        float offset = 0;
        for (int axis = 0; axis < 3; ++axis)
            offset += tiles.geometric_normal[axis][place] * tiles.position[axis][place];
        least = std::min(least, offset), most = std::max(most, offset);
    }
    tiles.plane_offset[tile] = 0.5f * (least + most);
    tiles.off_plane[tile] = 0.5f * (most - least);
}

void fill_tile(PixelTiles& tiles, std::size_t tile, const Images& images) {
    const int left = static_cast<int>(tile % tiles.columns) * PixelTiles::side;
    const int top = static_cast<int>(tile / tiles.columns) * PixelTiles::side;
    Extent positions, geometric_normals, normals;
    for (int pixel = 0; pixel < PixelTiles::pixels; ++pixel) {
        const int x = left + pixel % PixelTiles::side, y = top + pixel / PixelTiles::side;
        if (x >= tiles.width || y >= tiles.height) continue;
        const auto from = static_cast<std::size_t>(y) * tiles.width + x;
        const glm::vec3 geometric_normal(images.geometric_normal[from]);
        if (geometric_normal == glm::vec3(0)) continue;
        const glm::vec3 position(images.position[from]);
        const auto normal = glm::normalize(glm::vec3(glm::unpackHalf4x16(images.normal[from])));
        positions.add(position);
        geometric_normals.add(geometric_normal);
        normals.add(normal);
        tiles.valid[tile] |= std::uint64_t{1} << pixel;
        const auto to = tile * PixelTiles::pixels + static_cast<std::size_t>(pixel);
        for (int axis = 0; axis < 3; ++axis) {
            tiles.position[axis][to] = position[axis];
            tiles.geometric_normal[axis][to] = geometric_normal[axis];
            tiles.normal[axis][to] = normal[axis];
        }
    }
    if (tiles.valid[tile] == 0) return;
    positions.store(tiles.position_boxes, tile);
    geometric_normals.store(tiles.geometric_normal_boxes, tile);
    normals.store(tiles.normal_boxes, tile);
    find_plane(tiles, tile);
}

}  // namespace

PixelTiles make_pixel_tiles(int width, int height, std::span<const glm::vec4> position,
                            std::span<const std::uint64_t> normal,
                            std::span<const glm::vec4> geometric_normal) {
    PixelTiles tiles;
    tiles.width = width;
    tiles.height = height;
    tiles.columns = (width + PixelTiles::side - 1) / PixelTiles::side;
    const auto rows = (height + PixelTiles::side - 1) / PixelTiles::side;
    const auto count = static_cast<std::size_t>(tiles.columns) * rows;
    constexpr std::size_t padding = 16;  // at least the lanes of a vector of floats
    tiles.valid.assign(count, 0);
    tiles.plane_offset.assign(count + padding, 0.0f);
    tiles.off_plane.assign(count + padding, std::numeric_limits<float>::infinity());
    for (int axis = 0; axis < 3; ++axis) {
        for (auto* values : {&tiles.position[axis], &tiles.geometric_normal[axis], &tiles.normal[axis]})
            values->assign(count * PixelTiles::pixels, 0.0f);
        for (auto* boxes : {&tiles.position_boxes, &tiles.geometric_normal_boxes, &tiles.normal_boxes}) {
            boxes->centre[axis].assign(count + padding, 0.0f);
            boxes->half[axis].assign(count + padding, 0.0f);
        }
    }
    const Images images{position, normal, geometric_normal};
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t tile) { fill_tile(tiles, tile, images); });
    return tiles;
}

}  // namespace ir::passes::ldm
