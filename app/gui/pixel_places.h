#pragma once

#include <QPoint>
#include <QSize>
#include <optional>

/// Which pixels of images of several sizes show the same place: an image of a power of two less than the main
/// result is a level of it, everything else (textures, maps) has places of its own.
namespace ir::gui {

/// 0: of the main result's size; 1: half of it, rounded down, at least one pixel; …
std::optional<int> level_of(QSize main, QSize image);
/// The pixel of the main result on which the centre of the image's pixel lies; (-1, -1): the image is no
/// level of it.
QPoint pixel_of_main(QSize main, QSize image, QPoint pixel);
/// The pixel of the image that covers the centre of the main result's pixel; (-1, -1) likewise.
QPoint pixel_of_level(QSize main, QSize image, QPoint pixel);

}  // namespace ir::gui
