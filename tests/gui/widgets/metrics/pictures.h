#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QTest>

#include "tests/gui/widgets/surfaces.h"
#include "widgets/metrics/metrics_panel.h"

namespace ir::widgets {

using PicturePtr = std::shared_ptr<const Picture>;

/// A picture with something in each corner, so that one that is turned shows.
inline Image ramp(int width = 32, int height = 24, int channels = 3) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.at(x, y, c) =
                    0.1f + 0.4f * float(x) / float(width) + 0.3f * float(y * y) / float(height * height);
    return image;
}

/// The same with an error in its top left quarter alone.
inline Image with_error(Image image, float error = 0.05f) {
    for (int y = 0; y < image.height / 2; ++y)
        for (int x = 0; x < image.width / 2; ++x)
            for (int c = 0; c < image.channels; ++c) image.at(x, y, c) += error;
    return image;
}

inline PicturePtr radiance(Image image, const QString& label = {}) {
    return make_picture(std::move(image), Semantic::radiance, label);
}

inline MetricsRequest request_of(PicturePtr image, PicturePtr reference, const QRect& rectangle = {},
                                 const std::string& generation = "1") {
    MetricsRequest request;
    request.image = std::move(image);
    request.reference = std::move(reference);
    request.rectangle = rectangle;
    request.pair = "pair";
    request.generation = generation;
    return request;
}

/// Drags from a place of a view to another one, logical pixels.
inline void drag_mouse(QWidget& view, QPoint first, QPoint last, Qt::KeyboardModifiers modifiers = {}) {
    QTest::mousePress(&view, Qt::LeftButton, modifiers, first);
    for (int i = 1; i <= 4; ++i) {
        const QPoint at = first + (last - first) * i / 4;
        QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                         modifiers);
        QApplication::sendEvent(&view, &move);
    }
    QTest::mouseRelease(&view, Qt::LeftButton, modifiers, last);
}

inline void wait_for(MetricsPanel& panel) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !panel.is_computing(); }, 60000));
    QApplication::processEvents();
}

inline int row_of(const std::string& metric) {
    const auto& names = metric_names();
    return int(std::find(names.begin(), names.end(), metric) - names.begin());
}

}  // namespace ir::widgets
