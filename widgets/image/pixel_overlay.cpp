#include "widgets/image/pixel_overlay.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

/// Zoom (device pixels per pixel, at a pixel ratio of 1) from which the grid helps more than it hides.
constexpr double grid_zoom = 12;

struct VisiblePixels {
    int x0, y0, x1, y1;  ///< end is exclusive
};

VisiblePixels visible_pixels(const CanvasState& state) {
    const auto& t = state.transform;
    const QSize size = t.image_size().toSize();
    const QPointF first = t.image_from_view({0, 0});
    const QPointF last = t.image_from_view({t.view_size().width(), t.view_size().height()});
    return {std::clamp(int(std::floor(first.x())), 0, size.width()),
            std::clamp(int(std::floor(first.y())), 0, size.height()),
            std::clamp(int(std::ceil(last.x())), 0, size.width()),
            std::clamp(int(std::ceil(last.y())), 0, size.height())};
}

void paint_grid(QPainter& painter, const CanvasState& state, const VisiblePixels& seen) {
    painter.setPen(QPen(QColor(128, 128, 128, 110), 0));
    const auto& t = state.transform;
    for (int x = seen.x0; x <= seen.x1; ++x)
        painter.drawLine(t.view_from_image(QPointF(x, seen.y0)), t.view_from_image(QPointF(x, seen.y1)));
    for (int y = seen.y0; y <= seen.y1; ++y)
        painter.drawLine(t.view_from_image(QPointF(seen.x0, y)), t.view_from_image(QPointF(seen.x1, y)));
}

QString numbers_text(const PreparedPicture& picture, int x, int y) {
    if (picture.cover_at(x, y) == Cover::hidden && picture.display.hide_invalid) return QStringLiteral("–");
    const Image& image = *picture.picture->image;
    QStringList lines;
    for (int c = 0; c < std::min(image.channels, 4); ++c) lines << short_number(image.at(x, y, c));
    return lines.join(QLatin1Char('\n'));
}

/// Values of one pixel, one line per channel, in black or white, whichever reads better on its colour.
void paint_numbers_of(QPainter& painter, const PreparedPicture& picture, int x, int y, const QRectF& box) {
    if (picture.cover_at(x, y) == Cover::gap) return;
    const auto colour =
        shade(picture.display, &picture.shown->pixels[picture.shown->index(x, y)], picture.shown->channels);
    const double luma = 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
    painter.setPen(luma > 120 ? Qt::black : Qt::white);
    painter.drawText(box, Qt::AlignCenter, numbers_text(picture, x, y));
}

void paint_numbers(QPainter& painter, const CanvasState& state, const VisiblePixels& seen, qreal ratio) {
    int lines = 1;
    for (const auto& picture : state.pictures)
        if (!picture.empty()) lines = std::max(lines, std::min(picture.picture->image->channels, 4));
    QFont font = painter.font();
    const double zoom = state.transform.zoom();
    const double size = std::min({zoom / (lines + 1.0), zoom / 6.0, 13.0 * ratio});
    if (size < 7 * ratio) return;  // smaller cannot be read
    font.setPixelSize(int(size));
    painter.setFont(font);
    for (int y = seen.y0; y < seen.y1; ++y)
        for (int x = seen.x0; x < seen.x1; ++x)
            paint_numbers_of(painter, state.at(QPointF(x + 0.5, y + 0.5)), x, y,
                             QRectF(state.transform.view_from_image(QPointF(x, y)), QSizeF(zoom, zoom)));
}

}  // namespace

void paint_pixels(QPainter& painter, const CanvasState& state, qreal pixel_ratio) {
    if (!state.has_image() || !state.pixel_grid || state.transform.zoom() < grid_zoom * pixel_ratio) return;
    const VisiblePixels seen = visible_pixels(state);
    paint_grid(painter, state, seen);
    paint_numbers(painter, state, seen, pixel_ratio);
}

}  // namespace ir::widgets
