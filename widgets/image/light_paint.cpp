#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "widgets/image/light_tool.h"

namespace ir::widgets {
namespace {

constexpr QColor lamp_colour{255, 214, 92}, x_colour{236, 96, 88}, y_colour{112, 196, 92},
    z_colour{96, 152, 250}, shadow{0, 0, 0, 170};

QColor colour_of(LightHandle handle) {
    switch (handle) {
        case LightHandle::x:
            return x_colour;
        case LightHandle::y:
            return y_colour;
        case LightHandle::z:
            return z_colour;
        default:
            return lamp_colour;
    }
}

QString letter_of(LightHandle handle) {
    switch (handle) {
        case LightHandle::x:
            return QStringLiteral("x");
        case LightHandle::y:
            return QStringLiteral("y");
        case LightHandle::z:
            return QStringLiteral("z");
        default:
            return {};
    }
}

/// A line that shows on every colour.
void paint_line(QPainter& painter, const QPolygonF& points, const QColor& colour, qreal width, qreal ratio) {
    painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {QPen(shadow, (width + 2) * ratio), QPen(colour, width * ratio)}) {
        painter.setPen(pen);
        painter.drawPolyline(points);
    }
}

void paint_dot(QPainter& painter, QPointF at, const QColor& colour, qreal radius, qreal ratio) {
    painter.setPen(QPen(shadow, 1.5 * ratio));
    painter.setBrush(colour);
    painter.drawEllipse(at, radius * ratio, radius * ratio);
    painter.setBrush(Qt::NoBrush);
}

void paint_arrow(QPainter& painter, QPointF from, QPointF to, const QColor& colour, bool is_held,
                 qreal ratio) {
    paint_line(painter, {from, to}, colour, is_held ? 3 : 2, ratio);
    const QPointF along = to - from;
    const qreal length = std::hypot(along.x(), along.y());
    if (length < 1) return;
    const QPointF unit = along / length * ratio, across(-unit.y(), unit.x());
    const qreal size = is_held ? 7 : 5.5;
    QPainterPath head(to + 1.6 * size * unit);
    head.lineTo(to + size * across);
    head.lineTo(to - size * across);
    head.closeSubpath();
    painter.setPen(QPen(shadow, ratio));
    painter.setBrush(colour);
    painter.drawPath(head);
    painter.setBrush(Qt::NoBrush);
}

/// Lines of the outline that are in front of the camera; of a cone, some from its tip to the rim as well.
void paint_outline(QPainter& painter, const CanvasState& state, double length, qreal ratio) {
    const auto outline = outline_of(*state.light, length);
    const auto count = outline.size();
    QPolygonF line;
    const auto finish = [&] {
        if (line.size() > 1) paint_line(painter, line, lamp_colour, 1, ratio);
        line.clear();
    };
    for (std::size_t i = 0; count > 0 && i <= count; ++i)
        if (const auto at = seen_at(state, outline[i % count]))
            line << *at;
        else
            finish();
    finish();
    if (state.light->shape != PlacedLight::Shape::cone) return;
    const auto tip = seen_at(state, state.light->position);
    for (std::size_t i = 0; i < count; i += count / 4)
        if (const auto rim = seen_at(state, outline[i]); rim && tip)
            paint_line(painter, {*tip, *rim}, lamp_colour, 1, ratio);
}

void paint_letter(QPainter& painter, QPointF centre, QPointF end, LightHandle handle, qreal ratio) {
    const QPointF along = end - centre;
    const qreal length = std::max(1.0, std::hypot(along.x(), along.y()));
    QFont font = painter.font();
    font.setPixelSize(std::max(1, int(12 * ratio)));
    font.setBold(true);
    const QPointF at = end + along / length * 17 * ratio;
    const QRectF box(at - QPointF(8, 8) * ratio, QSizeF(16, 16) * ratio);
    painter.setFont(font);
    painter.setPen(Qt::NoPen);
    painter.setBrush(shadow);
    painter.drawEllipse(box);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(colour_of(handle));
    painter.drawText(box, Qt::AlignCenter, letter_of(handle));
}

}  // namespace

void paint_light(QPainter& painter, const CanvasState& state, qreal ratio) {
    const auto centre = seen_at(state, state.light->position);
    if (!centre) return;
    painter.save();
    const double length = handle_length(state, ratio);
    paint_outline(painter, state, length, ratio);
    auto handles = handles_of(*state.light);
    std::reverse(handles.begin(), handles.end());
    for (const auto handle : handles) {
        const bool is_held = handle == state.light_handle;
        const auto end = seen_at(state, end_of(*state.light, handle, length));
        if (handle == LightHandle::centre)
            paint_dot(painter, *centre, is_held ? QColor(Qt::white) : lamp_colour, is_held ? 8 : 6.5, ratio);
        else if (end && handle == LightHandle::direction) {
            paint_line(painter, {*centre, *end}, lamp_colour, is_held ? 3 : 2, ratio);
            paint_dot(painter, *end, is_held ? QColor(Qt::white) : lamp_colour, is_held ? 6.5 : 5, ratio);
        } else if (end) {
            paint_arrow(painter, *centre, *end, colour_of(handle), is_held, ratio);
            paint_letter(painter, *centre, *end, handle, ratio);
        }
    }
    painter.restore();
}

}  // namespace ir::widgets
