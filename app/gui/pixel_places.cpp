#include "app/gui/pixel_places.h"

#include <algorithm>

#include "widgets/compare/one_size.h"

namespace ir::gui {
namespace {

constexpr int max_levels = 16;

}  // namespace

std::optional<int> level_of(QSize main, QSize image) {
    if (main.isEmpty()) return {};
    for (int level = 0; level < max_levels; ++level)
        if (QSize(std::max(1, main.width() >> level), std::max(1, main.height() >> level)) == image)
            return level;
    return {};
}

QPoint pixel_of_main(QSize main, QSize image, QPoint pixel) {
    return pixel.x() >= 0 && level_of(main, image) ? widgets::pixel_at_size(pixel, image, main)
                                                   : QPoint(-1, -1);
}

QPoint pixel_of_level(QSize main, QSize image, QPoint pixel) {
    return pixel.x() >= 0 && level_of(main, image) ? widgets::pixel_at_size(pixel, main, image)
                                                   : QPoint(-1, -1);
}

}  // namespace ir::gui
