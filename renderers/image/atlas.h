#pragma once

#include <vector>

#include "renderers/image/image.h"

namespace ir {

/// Where one level or layer lies in a picture that shows all of them.
struct AtlasTile {
    int level = 0, layer = 0, x = 0, y = 0, width = 0, height = 0;
    bool operator==(const AtlasTile&) const = default;
};

/// All levels (a pyramid: the first on the left, the others stacked on its right) and all layers (in rows as
/// square as possible) of an image of width × height, with a gap of `gap` pixels between tiles.
struct Atlas {
    int width = 0, height = 0;
    std::vector<AtlasTile> tiles;
    /// The tile at a pixel; null in the gaps.
    const AtlasTile* tile_at(int x, int y) const;
    bool operator==(const Atlas&) const = default;
};
/// Where an image has pixels: the tiles of its atlas, or all of it where that has none.
std::vector<AtlasTile> tiles_of(const Image& image, const Atlas& atlas);
Atlas make_atlas(int width, int height, int levels, int layers, int gap = 2);

/// Copies a tile's picture to its place; both have the same channels.
void paste(Image& atlas, const AtlasTile& tile, const Image& picture);

}  // namespace ir
