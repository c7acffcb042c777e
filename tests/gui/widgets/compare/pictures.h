#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QTest>
#include <QWheelEvent>

#include "tests/gui/widgets/surfaces.h"
#include "widgets/compare/compare_view.h"

namespace ir::widgets {

using PicturePtr = std::shared_ptr<const Picture>;

/// Grey steps that differ in all corners, so that a picture that is turned or mirrored shows: the four
/// quarters are `scale` times 0.1, 0.3, 0.6, 1 (top left, top right, bottom left, bottom right).
inline Image quarters(float scale, int width = 16, int height = 12, int channels = 1) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
                const bool right = x >= width / 2, below = y >= height / 2;
                image.at(x, y, c) = scale * (below ? (right ? 1.0f : 0.6f) : (right ? 0.3f : 0.1f));
            }
    return image;
}

inline PicturePtr flat(float value, const QString& label = {}, int width = 16, int height = 12) {
    return make_picture(Image(width, height, 1, value), Semantic::depth, label);
}

/// Grey from 0 to 1.
inline Display grey_display() {
    Display display;
    display.mode = Display::Mode::scalar;
    display.colour_map = "grey";
    return display;
}

/// The grey that is seen at a point of a view's picture.
inline int grey_at(ImageView& view, double x, double y) {
    const QImage shot = view.grab().toImage();
    const QPointF at = view.transform().view_from_image({x, y});
    return shot.pixelColor(int(at.x()), int(at.y())).red();
}

inline int grey_of(double value) {
    return int(value * 255 + 0.5);
}

inline void show(CompareView& view) {
    show(view, {640, 480});
}

inline void wait_for_differences(CompareView& view) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !view.is_computing(); }, 60000));
}

/// The newest difference, once there is one.
inline const Image& shown_difference(CompareView& view) {
    wait_for_differences(view);
    static const Image none;
    return view.difference_picture() ? *view.difference_picture()->image : none;
}

inline void fill(CompareView& view, std::vector<PicturePtr> pictures) {
    const std::vector<Display> displays(pictures.size(), grey_display());
    view.set_pictures(std::move(pictures));
    view.set_displays(displays);
}

inline void turn_wheel(QWidget* widget, QPointF at, int steps) {
    QWheelEvent wheel(at, widget->mapToGlobal(at), {}, {0, 120 * steps}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(widget, &wheel);
}

/// Widget coordinates of a point of the picture.
inline QPoint point(const ImageView& view, double x, double y) {
    return (view.transform().view_from_image({x, y}) / view.devicePixelRatioF()).toPoint();
}

class CompareTest : public SurfaceTest {};

}  // namespace ir::widgets
