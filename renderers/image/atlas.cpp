#include "renderers/image/atlas.h"

#include <algorithm>
#include <cmath>

namespace ir {
namespace {

/// One layer's levels from (x, y) on; returns their extent.
std::pair<int, int> place_levels(std::vector<AtlasTile>& tiles, int x, int y, int width, int height,
                                 int levels, int layer, int gap) {
    int right = 0, below = 0;
    for (int level = 0; level < levels; ++level) {
        const int w = std::max(1, width >> level), h = std::max(1, height >> level);
        if (level == 0) {
            tiles.push_back({level, layer, x, y, w, h});
            continue;
        }
        tiles.push_back({level, layer, x + width + gap, y + below, w, h});
        right = std::max(right, w + gap);
        below += h + gap;
    }
    return {width + right, std::max(height, below - (levels > 1 ? gap : 0))};
}

}  // namespace

const AtlasTile* Atlas::tile_at(int x, int y) const {
    for (const auto& tile : tiles)
        if (x >= tile.x && y >= tile.y && x < tile.x + tile.width && y < tile.y + tile.height) return &tile;
    return nullptr;
}

std::vector<AtlasTile> tiles_of(const Image& image, const Atlas& atlas) {
    return atlas.tiles.empty() ? std::vector<AtlasTile>{{0, 0, 0, 0, image.width, image.height}}
                               : atlas.tiles;
}

Atlas make_atlas(int width, int height, int levels, int layers, int gap) {
    Atlas atlas;
    std::vector<AtlasTile> probe;
    const auto [cell_width, cell_height] = place_levels(probe, 0, 0, width, height, levels, 0, gap);
    const double side = std::sqrt(double(layers) * cell_height / std::max(1, cell_width));
    const int columns = std::clamp(int(std::lround(side)), 1, std::max(1, layers));
    const int rows = (layers + columns - 1) / columns;
    for (int layer = 0; layer < layers; ++layer)
        place_levels(atlas.tiles, layer % columns * (cell_width + gap), layer / columns * (cell_height + gap),
                     width, height, levels, layer, gap);
    atlas.width = columns * (cell_width + gap) - gap;
    atlas.height = rows * (cell_height + gap) - gap;
    return atlas;
}

void paste(Image& atlas, const AtlasTile& tile, const Image& picture) {
    for (int y = 0; y < tile.height; ++y)
        std::copy_n(&picture.pixels[picture.index(0, y)], std::size_t(tile.width) * picture.channels,
                    &atlas.pixels[atlas.index(tile.x, tile.y + y)]);
}

}  // namespace ir
