#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "widgets/image/canvas.h"

namespace ir::widgets {
namespace {

/// Zoom (device pixels per pixel) from which the grid helps more than it hides.
constexpr double grid_zoom = 12;

struct VisiblePixels {
    int x0, y0, x1, y1;  ///< end is exclusive
};

VisiblePixels visible_pixels(const CanvasState& state) {
    const auto& t = state.transform;
    const QPointF first = t.image_from_view({0, 0});
    const QPointF last = t.image_from_view({t.view_size().width(), t.view_size().height()});
    return {std::clamp(int(std::floor(first.x())), 0, state.image.width),
            std::clamp(int(std::floor(first.y())), 0, state.image.height),
            std::clamp(int(std::ceil(last.x())), 0, state.image.width),
            std::clamp(int(std::ceil(last.y())), 0, state.image.height)};
}

void paint_grid(QPainter& painter, const CanvasState& state, const VisiblePixels& seen) {
    painter.setPen(QPen(QColor(128, 128, 128, 110), 0));
    const auto& t = state.transform;
    for (int x = seen.x0; x <= seen.x1; ++x)
        painter.drawLine(t.view_from_image(QPointF(x, seen.y0)), t.view_from_image(QPointF(x, seen.y1)));
    for (int y = seen.y0; y <= seen.y1; ++y)
        painter.drawLine(t.view_from_image(QPointF(seen.x0, y)), t.view_from_image(QPointF(seen.x1, y)));
}

/// Values of one pixel, one line per channel, in black or white, whichever reads better on its colour.
void paint_numbers_of(QPainter& painter, const CanvasState& state, int x, int y, const QRectF& box) {
    const auto colour =
        shade(state.display, &state.shown.pixels[state.shown.index(x, y)], state.shown.channels);
    const double luma = 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
    painter.setPen(luma > 120 ? Qt::black : Qt::white);
    QStringList lines;
    for (int c = 0; c < std::min(state.image.channels, 4); ++c)
        lines << short_number(state.image.at(x, y, c));
    painter.drawText(box, Qt::AlignCenter, lines.join(QLatin1Char('\n')));
}

void paint_numbers(QPainter& painter, const CanvasState& state, const VisiblePixels& seen, qreal ratio) {
    const int lines = std::min(state.image.channels, 4);
    QFont font = painter.font();
    const double zoom = state.transform.zoom();
    const double size = std::min({zoom / (lines + 1.0), zoom / 6.0, 13.0 * ratio});
    if (size < 7 * ratio) return;  // smaller cannot be read
    font.setPixelSize(int(size));
    painter.setFont(font);
    for (int y = seen.y0; y < seen.y1; ++y)
        for (int x = seen.x0; x < seen.x1; ++x)
            paint_numbers_of(painter, state, x, y,
                             QRectF(state.transform.view_from_image(QPointF(x, y)), QSizeF(zoom, zoom)));
}

void paint_badge(QPainter& painter, const QRectF& view, const QString& text, Qt::Alignment where,
                 qreal ratio) {
    QFont font = painter.font();
    font.setPixelSize(int(12 * ratio));
    painter.setFont(font);
    QRectF box = painter.boundingRect(view, Qt::AlignLeft | Qt::AlignTop, text)
                     .adjusted(-8 * ratio, -4 * ratio, 8 * ratio, 4 * ratio);
    const qreal gap = 10 * ratio;
    box.moveLeft(where & Qt::AlignRight ? view.right() - box.width() - gap : view.left() + gap);
    box.moveTop(where & Qt::AlignBottom ? view.bottom() - box.height() - gap : view.top() + gap);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 190));
    painter.drawRoundedRect(box, 4 * ratio, 4 * ratio);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(box, Qt::AlignCenter, text);
}

void paint_note(QPainter& painter, const QRectF& view, const QString& text, qreal ratio) {
    QFont font = painter.font();
    font.setPixelSize(int(15 * ratio));
    painter.setFont(font);
    painter.setPen(QColor(24, 24, 24));
    const qreal margin = 40 * ratio;
    painter.drawText(view.adjusted(margin, margin, -margin, -margin), Qt::AlignCenter | Qt::TextWordWrap,
                     text);
}

void paint_picked(QPainter& painter, const CanvasState& state, qreal ratio) {
    if (state.picked.x() < 0 || state.picked.x() >= state.image.width || state.picked.y() < 0 ||
        state.picked.y() >= state.image.height)
        return;
    const double zoom = state.transform.zoom();
    QRectF box(state.transform.view_from_image(state.picked), QSizeF(zoom, zoom));
    if (zoom < 6 * ratio) {
        const QPointF middle = box.center();
        box = QRectF(middle.x() - 3 * ratio, middle.y() - 3 * ratio, 6 * ratio, 6 * ratio);
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Qt::black, 3 * ratio));
    painter.drawRect(box);
    painter.setPen(QPen(Qt::white, ratio));
    painter.drawRect(box);
}

void paint_overlay(QPainter& painter, const CanvasState& state, qreal ratio) {
    painter.save();
    painter.scale(1 / ratio, 1 / ratio);  // everything below is in device pixels
    const QRectF view({0, 0}, state.transform.view_size());
    if (!state.image.empty()) {
        const VisiblePixels seen = visible_pixels(state);
        if (state.pixel_grid && state.transform.zoom() >= grid_zoom * ratio) {
            paint_grid(painter, state, seen);
            paint_numbers(painter, state, seen, ratio);
        }
        painter.setRenderHint(QPainter::Antialiasing);
        paint_picked(painter, state, ratio);
    }
    painter.setRenderHint(QPainter::Antialiasing);
    if (!state.note.isEmpty()) paint_note(painter, view, state.note, ratio);
    if (!state.hint.isEmpty()) paint_badge(painter, view, state.hint, Qt::AlignLeft | Qt::AlignBottom, ratio);
    if (state.stale && !state.image.empty())
        paint_badge(painter, view, QStringLiteral("rendering …"), Qt::AlignRight | Qt::AlignTop, ratio);
    painter.restore();
}

class Overlay final : public QWidget {
  public:
    Overlay(const CanvasState& state, QWidget* parent) : QWidget(parent), state_(state) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setAttribute(Qt::WA_NoSystemBackground);
    }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        paint_overlay(painter, state_, devicePixelRatioF());
    }

  private:
    const CanvasState& state_;
};

}  // namespace

QWidget* make_overlay(const CanvasState& state, QWidget* parent) {
    return new Overlay(state, parent);
}

}  // namespace ir::widgets
