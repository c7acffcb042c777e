#include "app/gui/pixel_places.h"

#include <algorithm>

namespace ir::gui {
namespace {

constexpr int most_levels = 16;

QPoint scaled(QPoint pixel, QSize from, QSize to) {
    const auto along = [](int at, int before, int after) {
        return int((2 * qint64(at) + 1) * after / (2 * qint64(before)));
    };
    return {along(pixel.x(), from.width(), to.width()), along(pixel.y(), from.height(), to.height())};
}

}  // namespace

std::optional<int> level_of(QSize main, QSize image) {
    if (main.isEmpty()) return {};
    for (int level = 0; level < most_levels; ++level)
        if (QSize(std::max(1, main.width() >> level), std::max(1, main.height() >> level)) == image)
            return level;
    return {};
}

QPoint pixel_of_main(QSize main, QSize image, QPoint pixel) {
    return pixel.x() >= 0 && level_of(main, image) ? scaled(pixel, image, main) : QPoint(-1, -1);
}

QPoint pixel_of_level(QSize main, QSize image, QPoint pixel) {
    return pixel.x() >= 0 && level_of(main, image) ? scaled(pixel, main, image) : QPoint(-1, -1);
}

}  // namespace ir::gui
