#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "widgets/image/canvas.h"
#include "widgets/image/legend.h"
#include "widgets/image/light_tool.h"

namespace ir::widgets {
namespace {

/// Logical pixels on either side of the divider that take hold of it.
constexpr double divider_reach = 7;
constexpr double lens_part = 0.36;  ///< of the view's shorter side

void set_font_size(QPainter& painter, qreal size) {
    QFont font = painter.font();
    font.setPixelSize(std::max(1, int(size)));
    painter.setFont(font);
}

/// What becomes of a text that is too long: it loses its middle, or is wrapped between its parts.
enum class Overlong { elide, wrap };

/// A text on a dark plate in a corner of `area`. Returns the plate.
QRectF paint_badge(QPainter& painter, const QRectF& area, const QString& text, Qt::Alignment where,
                   Overlong overlong, qreal ratio) {
    const qreal gap = 8 * ratio;
    const QRectF room = area.adjusted(gap, gap, -gap, -gap);
    if (text.isEmpty() || room.width() < 24 * ratio) return {};
    set_font_size(painter, 12 * ratio);
    int flags = int(Qt::AlignLeft | Qt::AlignTop);
    if (overlong == Overlong::wrap) flags |= int(Qt::TextWordWrap);
    const QMarginsF border(7 * ratio, 4 * ratio, 7 * ratio, 4 * ratio);
    const QRectF inside = room - border;
    const auto metrics = painter.fontMetrics();
    const QString fitting = overlong == Overlong::wrap
                                ? wrapped_hint(text, metrics, int(inside.width()))
                                : metrics.elidedText(text, Qt::ElideMiddle, int(inside.width()));
    QRectF box = painter.boundingRect(inside, flags, fitting) + border;
    box.moveLeft(where & Qt::AlignRight ? room.right() - box.width() : room.left());
    box.moveTop(where & Qt::AlignBottom ? room.bottom() - box.height() : room.top());
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 190));
    painter.drawRoundedRect(box, 4 * ratio, 4 * ratio);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(box - border + QMarginsF(0, 0, ratio, ratio), flags, fitting);
    return box;
}

void paint_note(QPainter& painter, const QRectF& view, const QString& text, qreal ratio) {
    set_font_size(painter, 15 * ratio);
    painter.setPen(QColor(24, 24, 24));
    const qreal margin = std::min(40 * ratio, view.width() / 10);
    painter.drawText(view.adjusted(margin, margin, -margin, -margin), Qt::AlignCenter | Qt::TextWordWrap,
                     text);
}

void paint_frame(QPainter& painter, const QRectF& box, const QColor& colour, qreal ratio) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Qt::black, 3 * ratio));
    painter.drawRect(box);
    painter.setPen(QPen(colour, ratio));
    painter.drawRect(box);
}

/// A pixel's box in the view, never smaller than can be seen; null outside the picture.
QRectF pixel_box(const CanvasState& state, QPoint pixel, qreal ratio) {
    if (!QRect(QPoint(0, 0), state.transform.image_size().toSize()).contains(pixel)) return {};
    const double zoom = state.transform.zoom();
    const QRectF box(state.transform.view_from_image(pixel), QSizeF(zoom, zoom));
    if (zoom >= 6 * ratio) return box;
    return QRectF(box.center() - QPointF(3, 3) * ratio, QSizeF(6, 6) * ratio);
}

/// A frame around the pixel and its number at the corner.
void paint_pin(QPainter& painter, const CanvasState& state, const PinMark& pin, qreal ratio) {
    const QRectF box = pixel_box(state, pin.pixel, ratio);
    if (box.isNull()) return;
    paint_frame(painter, box, pin.colour, ratio);
    QFont font = painter.font();
    font.setPixelSize(int(10 * ratio));
    font.setBold(true);
    painter.setFont(font);
    const QRectF label(box.topRight() + QPointF(2, -13) * ratio, QSizeF(13, 13) * ratio);
    painter.setPen(QPen(Qt::black, ratio));
    painter.setBrush(pin.colour);
    painter.drawEllipse(label);
    painter.setPen(Qt::black);
    painter.drawText(label, Qt::AlignCenter, QString::number(pin.number));
    painter.setBrush(Qt::NoBrush);
}

/// On the side of the pixel where there is more room.
void paint_said(QPainter& painter, const CanvasState& state, const QRectF& view, qreal ratio) {
    const QRectF box = pixel_box(state, state.marks.said.pixel, ratio) & view;
    if (box.isEmpty()) return;
    const bool is_left = box.center().x() > view.center().x(),
               is_above = box.center().y() > view.center().y();
    const QRectF room(QPointF(is_left ? view.left() : box.right(), is_above ? view.top() : box.top()),
                      QPointF(is_left ? box.left() : view.right(), is_above ? box.bottom() : view.bottom()));
    paint_badge(painter, room, state.marks.said.text,
                (is_left ? Qt::AlignRight : Qt::AlignLeft) | (is_above ? Qt::AlignBottom : Qt::AlignTop),
                Overlong::wrap, ratio);
}

/// Four short lines around the pixel, which leave it free.
void paint_cursor_mark(QPainter& painter, const CanvasState& state, qreal ratio) {
    const QRectF box = pixel_box(state, state.marks.cursor, ratio);
    if (box.isNull()) return;
    const qreal length = 9 * ratio;
    const QPointF c = box.center();
    const qreal x = box.width() / 2 + ratio, y = box.height() / 2 + ratio;
    for (const QPen& pen : {QPen(Qt::black, 3 * ratio), QPen(Qt::white, ratio)}) {
        painter.setPen(pen);
        painter.drawLine(c - QPointF(x, 0), c - QPointF(x + length, 0));
        painter.drawLine(c + QPointF(x, 0), c + QPointF(x + length, 0));
        painter.drawLine(c - QPointF(0, y), c - QPointF(0, y + length));
        painter.drawLine(c + QPointF(0, y), c + QPointF(0, y + length));
    }
}

/// A line that shows on every colour and a handle in the middle of what is seen of the picture.
void paint_divider(QPainter& painter, const CanvasState& state, const QRectF& view, qreal ratio) {
    const auto& t = state.transform;
    const QRectF picture(t.offset(), t.image_size() * t.zoom());
    const QRectF seen = picture & view;
    if (seen.isEmpty()) return;
    const qreal x = state.divider_x();
    for (const QPen& pen : {QPen(QColor(0, 0, 0, 160), 3 * ratio), QPen(Qt::white, ratio)}) {
        painter.setPen(pen);
        painter.drawLine(QPointF(x, seen.top()), QPointF(x, seen.bottom()));
    }
    const QPointF middle(x, seen.center().y());
    painter.setPen(QPen(QColor(0, 0, 0, 160), ratio));
    painter.setBrush(Qt::white);
    painter.drawEllipse(middle, 10 * ratio, 10 * ratio);
    QPainterPath arrows;
    for (int side : {-1, 1}) {
        arrows.moveTo(middle + QPointF(side * 7, 0) * ratio);
        arrows.lineTo(middle + QPointF(side * 2.5, -4) * ratio);
        arrows.lineTo(middle + QPointF(side * 2.5, 4) * ratio);
        arrows.closeSubpath();
    }
    painter.fillPath(arrows, QColor(40, 40, 40));
}

/// A frame that shows on every colour.
void paint_lens(QPainter& painter, const CanvasState& state, qreal ratio) {
    const QRectF area = state.second_area();
    if (area.isEmpty()) return;
    painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {QPen(QColor(0, 0, 0, 160), 3 * ratio), QPen(Qt::white, ratio)}) {
        painter.setPen(pen);
        painter.drawRect(area);
    }
}

/// Names of levels and slices in the corner of their tiles, where a tile is large enough for it.
void paint_tiles(QPainter& painter, const CanvasState& state, qreal ratio) {
    const Atlas& atlas = state.pictures[0].picture->atlas;
    set_font_size(painter, 11 * ratio);
    const QFontMetricsF metrics(painter.font());
    for (const auto& tile : atlas.tiles) {
        const QString name = tile_name(atlas, tile);
        const double zoom = state.transform.zoom();
        const QRectF box(state.transform.view_from_image(QPointF(tile.x, tile.y)),
                         QSizeF(tile.width * zoom, tile.height * zoom));
        const QSizeF plate(metrics.horizontalAdvance(name) + 6 * ratio, metrics.height());
        if (name.isEmpty() || plate.width() > box.width() || plate.height() > box.height()) continue;
        const QRectF place(box.bottomLeft() - QPointF(0, plate.height()), plate);
        painter.fillRect(place, QColor(20, 20, 20, 170));
        painter.setPen(QColor(235, 235, 235));
        painter.drawText(place, Qt::AlignCenter, name);
    }
}

/// The label with what the picture is instead, or that a newer one is on its way.
QString marked(const QString& label, const Picture* picture, bool stale) {
    const QString mark = picture && !picture->draft.isEmpty() ? picture->draft
                         : stale                              ? QStringLiteral("rendering …")
                                                              : QString();
    return label.isEmpty() || mark.isEmpty() ? label + mark : label + QStringLiteral("  ·  ") + mark;
}

/// Labels keep to their side of the divider, or to their half.
void paint_labels(QPainter& painter, const CanvasState& state, const QRectF& view, qreal ratio) {
    QRectF left = view, right;
    if (state.has_second() && state.has_lens) {
        left.setWidth(view.width() / 2);
        right = left.translated(left.width(), 0);
    }
    if (state.has_divider()) {
        const qreal x = std::clamp<qreal>(state.divider_x(), 0, view.width());
        left.setRight(x);
        right = QRectF(x, 0, view.width() - x, view.height());
    }
    const auto side = state.label.isEmpty() ? Qt::AlignRight : Qt::AlignLeft;
    paint_badge(painter, left,
                marked(state.label, state.pictures[0].picture.get(), state.stale && state.has_image()),
                side | Qt::AlignTop, Overlong::elide, ratio);
    if (state.has_second())
        paint_badge(painter, right, marked(state.second_label, state.pictures[1].picture.get(), false),
                    Qt::AlignRight | Qt::AlignTop, Overlong::elide, ratio);
}

/// Of two pictures that are shown differently, one on either side.
bool has_two_legends(const CanvasState& state) {
    return state.has_second() && state.pictures[0].display != state.pictures[1].display;
}

QRectF picture_box(const CanvasState& state) {
    return {state.transform.offset(), state.transform.image_size() * state.transform.zoom()};
}

/// Of a legend that stands beside the picture.
QRectF legend_column(const CanvasState& state, const QRectF& view, qreal ratio) {
    const QRectF picture = picture_box(state);
    const qreal gap = 8 * ratio;
    const QSizeF size = legend_size(state.pictures[0], ratio, view.height() - 2 * gap);
    const qreal x = std::min(std::max(picture.right(), 0.0) + gap, view.width() - size.width() - gap);
    const qreal y = std::clamp(picture.bottom() - size.height(), gap, view.height() - size.height() - gap);
    return {{x, y}, size};
}

/// Where a legend that is a line begins.
qreal legend_top(const CanvasState& state, const QRectF& view, qreal ratio) {
    return std::min(std::max(picture_box(state).bottom(), 0.0), view.height() - legend_line_height(ratio));
}

/// Off the legend: below it where there is room for a line, else above.
QRectF hint_room(const CanvasState& state, const QRectF& view, qreal ratio) {
    constexpr qreal line = 40;
    QRectF room = view;
    if (!state.legend || !state.has_image() || !has_legend(state.pictures[0])) return room;
    if (!legend_place(state, ratio).is_line) {
        room.setRight(legend_column(state, view, ratio).left());
        return room;
    }
    const qreal top = legend_top(state, view, ratio), bottom = top + legend_line_height(ratio);
    if (view.bottom() - bottom < line * ratio)
        room.setBottom(top);
    else
        room.setTop(bottom);
    return room;
}

void paint_legends(QPainter& painter, const CanvasState& state, const QRectF& view, qreal ratio) {
    const auto place = legend_place(state, ratio);
    const QRectF picture = picture_box(state);
    if (place.is_line) {
        const qreal height = legend_line_height(ratio);
        const qreal top = legend_top(state, view, ratio);
        const int count = has_two_legends(state) ? 2 : 1;
        const QRectF row = QRectF(picture.left(), top, picture.width(), height) & view;
        // Of a narrow picture it may be wider.
        const qreal width = std::min(std::max(row.width(), 260 * ratio), view.width());
        const qreal left = std::clamp(row.center().x() - width / 2, 0.0, view.width() - width);
        for (int i = 0; i < count; ++i)
            paint_legend_line(painter, state.pictures[i],
                              {left + i * width / count, top, width / count, height}, ratio);
        return;
    }
    paint_legend(painter, state.pictures[0], legend_column(state, view, ratio).topLeft(), ratio,
                 view.height() - 16 * ratio);
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
        const qreal ratio = devicePixelRatioF();
        painter.scale(1 / ratio, 1 / ratio);
        paint_overlay(painter, state_, ratio);
    }

  private:
    const CanvasState& state_;
};

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

/// Grid and numbers in zoomed pixels, where the zoom is large enough. Unit: a device pixel.
void paint_pixels(QPainter& painter, const CanvasState& state, qreal pixel_ratio) {
    if (!state.has_image() || !state.pixel_grid || state.transform.zoom() < grid_zoom * pixel_ratio) return;
    const VisiblePixels seen = visible_pixels(state);
    paint_grid(painter, state, seen);
    paint_numbers(painter, state, seen, pixel_ratio);
}

/// Lines between pixels, in whole device pixels.
QRectF region_box(const CanvasState& state) {
    const QPointF from = state.transform.view_from_image(state.marks.region.topLeft());
    const QPointF to = state.transform.view_from_image(state.marks.region.bottomRight() + QPoint(1, 1));
    return {QPointF(std::round(from.x()), std::round(from.y())),
            QPointF(std::round(to.x()), std::round(to.y()))};
}

void paint_handles(QPainter& painter, const QRectF& box, qreal ratio) {
    const qreal side = 7 * ratio;
    painter.setPen(QPen(Qt::black, ratio));
    painter.setBrush(Qt::white);
    for (const qreal x : {box.left(), box.center().x(), box.right()})
        for (const qreal y : {box.top(), box.center().y(), box.bottom()}) {
            const bool middle_x = x == box.center().x(), middle_y = y == box.center().y();
            if (middle_x && middle_y) continue;
            if ((middle_x && box.width() < 4 * side) || (middle_y && box.height() < 4 * side)) continue;
            painter.drawRect(QRectF(x - side / 2, y - side / 2, side, side));
        }
    painter.setBrush(Qt::NoBrush);
}

/// A text below a shape, or above it where the view ends; none in a view that is small beside it.
void paint_measure(QPainter& painter, const CanvasState& state, const QRectF& box, const QString& text,
                   qreal ratio) {
    QFont font = painter.font();
    font.setPixelSize(std::max(1, int(11 * ratio)));
    painter.setFont(font);
    const QFontMetricsF metrics(font);
    const QSizeF plate(metrics.horizontalAdvance(text) + 8 * ratio, metrics.height() + 2 * ratio);
    const QSizeF picture = state.transform.image_size() * state.transform.zoom();
    constexpr double most = 0.5;  // of the picture's width, and a quarter of its height
    if (plate.width() > most * picture.width() || plate.height() > most / 2 * picture.height()) return;
    QRectF place(box.left(), box.bottom() + 7 * ratio, plate.width(), plate.height());
    const QSizeF view = state.transform.view_size();
    if (place.bottom() > view.height()) place.moveBottom(box.top() - 7 * ratio);
    if (place.top() < 0) place.moveTopLeft(box.topLeft() + QPointF(7, 7) * ratio);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 190));
    painter.drawRoundedRect(place, 3 * ratio, 3 * ratio);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(place, Qt::AlignCenter, text);
}

/// The rectangle that is measured: a line that shows on every colour and tints none; with handles and its
/// size while it is being edited.
void paint_region(QPainter& painter, const CanvasState& state, qreal ratio) {
    if (state.marks.region.isEmpty()) return;
    const QRectF box = region_box(state);
    painter.save();
    painter.setBrush(Qt::NoBrush);
    QPen dark(QColor(0, 0, 0, 190), 3 * ratio);
    dark.setJoinStyle(Qt::MiterJoin);
    painter.setPen(dark);
    painter.drawRect(box);
    QPen dashes(Qt::white, ratio);
    dashes.setJoinStyle(Qt::MiterJoin);
    dashes.setDashPattern({6, 3});
    painter.setPen(dashes);
    painter.drawRect(box);
    if (state.region_edited) {
        paint_handles(painter, box, ratio);
        paint_measure(
            painter, state, box,
            QStringLiteral("%1 × %2").arg(state.marks.region.width()).arg(state.marks.region.height()),
            ratio);
    }
    painter.restore();
}

/// The line whose values are plotted: its start is a square, its end a disc.
void paint_line(QPainter& painter, const CanvasState& state, qreal ratio) {
    const QLine& line = state.marks.line;
    if (line.isNull()) return;
    const QPointF start = state.transform.view_from_pixel(line.p1()),
                  end = state.transform.view_from_pixel(line.p2());
    painter.save();
    painter.setPen(QPen(QColor(0, 0, 0, 190), 3 * ratio));
    painter.drawLine(start, end);
    painter.setPen(QPen(Qt::white, ratio));
    painter.drawLine(start, end);
    const qreal radius = (state.line_edited ? 4 : 3) * ratio;
    painter.setPen(QPen(Qt::black, ratio));
    painter.setBrush(Qt::white);
    painter.drawRect(QRectF(start - QPointF(radius, radius), 2 * QSizeF(radius, radius)));
    painter.drawEllipse(end, radius, radius);
    if (state.line_edited)
        paint_measure(
            painter, state, QRectF(start, end).normalized(),
            QStringLiteral("%1, %2 → %3, %4").arg(line.x1()).arg(line.y1()).arg(line.x2()).arg(line.y2()),
            ratio);
    painter.restore();
}

}  // namespace

int CanvasState::divider_x() const {
    if (!has_divider()) return int(std::ceil(transform.view_size().width()));
    return int(std::lround(transform.view_from_image({wipe * transform.image_size().width(), 0}).x()));
}

bool CanvasState::is_over_divider(QPointF place, qreal ratio) const {
    if (!has_divider()) return false;
    const QRectF picture = picture_box(*this);
    return place.y() >= picture.top() && place.y() < picture.bottom() &&
           std::abs(place.x() - divider_x()) <= divider_reach * ratio;
}

QPoint CanvasState::move_lens(QPointF way) {
    lens = {std::clamp(lens.x() + way.x(), 0.0, 1.0), std::clamp(lens.y() + way.y(), 0.0, 1.0)};
    const QSize size = transform.image_size().toSize();
    return {std::min(int(lens.x() * size.width()), size.width() - 1),
            std::min(int(lens.y() * size.height()), size.height() - 1)};
}

QRect CanvasState::second_area() const {
    const QRect view(QPoint(0, 0), transform.view_size().toSize());
    if (!has_second()) return {};
    if (!has_lens) return view & QRect(divider_x(), 0, view.width(), view.height());
    const QSizeF size = transform.image_size();
    const QPoint middle =
        transform.view_from_image({lens.x() * size.width(), lens.y() * size.height()}).toPoint();
    const int half = int(lens_part / 2 * std::min(view.width(), view.height()));
    return view & QRect(middle - QPoint(half, half), QSize(2 * half, 2 * half)) &
           picture_box(*this).toAlignedRect();
}

const PreparedPicture& CanvasState::at(QPointF image_px) const {
    const QPointF place = transform.view_from_image(image_px);
    const bool is_second = has_divider() ? place.x() >= divider_x() : QRectF(second_area()).contains(place);
    return pictures[is_second ? 1 : 0];
}

LegendPlace legend_place(const CanvasState& state, qreal ratio) {
    if (!(state.legend || state.legend_room) || !state.has_image() || !has_legend(state.pictures[0]))
        return {};
    const QSizeF view = state.transform.view_size(), image = state.transform.image_size();
    const LegendPlace line{true, {0, legend_line_height(ratio)}};
    if (has_two_legends(state)) return line;
    const qreal gap = 8 * ratio, room = view.height() - 2 * gap;
    const QSizeF size = legend_size(state.pictures[0], ratio, room);
    const LegendPlace column{false, {size.width() + 2 * gap, 0}};
    const auto zoom = [&](const LegendPlace& place) {
        const QSizeF left = view - place.margins;
        return std::min(left.width() / image.width(), left.height() / image.height());
    };
    return size.height() > room || zoom(line) > zoom(column) ? line : column;
}

int pattern_half(qreal pixel_ratio) {
    return std::max(2, int(std::lround(3 * pixel_ratio)));
}

void paint_overlay(QPainter& painter, const CanvasState& state, qreal ratio) {
    painter.save();
    const QRectF view({0, 0}, state.transform.view_size());
    paint_pixels(painter, state, ratio);
    painter.setRenderHint(QPainter::Antialiasing);
    if (state.has_image()) {
        paint_tiles(painter, state, ratio);
        paint_region(painter, state, ratio);
        paint_line(painter, state, ratio);
        if (state.has_divider()) paint_divider(painter, state, view, ratio);
        if (state.has_lens) paint_lens(painter, state, ratio);
        for (const auto& pin : state.marks.pins) paint_pin(painter, state, pin, ratio);
        const QRectF picked = pixel_box(state, state.marks.picked, ratio);
        if (!picked.isNull()) paint_frame(painter, picked, Qt::white, ratio);
        paint_said(painter, state, view, ratio);
        paint_cursor_mark(painter, state, ratio);
        if (state.light) paint_light(painter, state, ratio);
    }
    if (!state.note.isEmpty()) paint_note(painter, view, state.note, ratio);
    paint_labels(painter, state, view, ratio);
    const bool has_legends = state.legend && state.has_image() && has_legend(state.pictures[0]);
    // Who has drawn a shape knows how, and in a small view the hint would cover it.
    const bool has_shape = (state.line_edited && !state.marks.line.isNull()) ||
                           (state.region_edited && !state.marks.region.isEmpty());
    if (!state.hint.isEmpty() && !has_shape)
        paint_badge(painter, hint_room(state, view, ratio), state.hint, Qt::AlignLeft | Qt::AlignBottom,
                    Overlong::wrap, ratio);
    if (has_legends) paint_legends(painter, state, view, ratio);
    painter.restore();
}

QString wrapped_hint(const QString& hint, const QFontMetrics& metrics, int width) {
    const QString between = QStringLiteral("  ·  ");
    QString text, line;
    for (const auto& part : hint.split(between)) {
        const QString longer = line.isEmpty() ? part : line + between + part;
        if (!line.isEmpty() && metrics.horizontalAdvance(longer) > width) {
            text += line + QLatin1Char('\n');
            line = part;
        } else {
            line = longer;
        }
    }
    return text + line;
}

QWidget* make_overlay(const CanvasState& state, QWidget* parent) {
    return new Overlay(state, parent);
}

}  // namespace ir::widgets
