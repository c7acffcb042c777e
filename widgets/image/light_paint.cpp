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

/// Lines that show on every colour.
void paint_lines(QPainter& painter, const QPainterPath& lines, const QColor& colour, qreal width,
                 qreal ratio) {
    painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {QPen(shadow, (width + 2) * ratio), QPen(colour, width * ratio)}) {
        painter.setPen(pen);
        painter.drawPath(lines);
    }
}

void paint_line(QPainter& painter, const QPolygonF& points, const QColor& colour, qreal width, qreal ratio) {
    QPainterPath line;
    line.addPolygon(points);
    paint_lines(painter, line, colour, width, ratio);
}

void paint_ring(QPainter& painter, QPointF centre, qreal radius, const QColor& colour, qreal width,
                qreal ratio) {
    QPainterPath ring;
    ring.addEllipse(centre, radius, radius);
    paint_lines(painter, ring, colour, width, ratio);
}

void paint_dot(QPainter& painter, QPointF at, const QColor& colour, qreal radius, qreal ratio) {
    painter.setPen(QPen(shadow, 1.5 * ratio));
    painter.setBrush(colour);
    painter.drawEllipse(at, radius * ratio, radius * ratio);
    painter.setBrush(Qt::NoBrush);
}

/// Of what cannot be moved: a dark dot with a ring.
void paint_foot(QPainter& painter, QPointF at, qreal ratio) {
    paint_dot(painter, at, QColor(24, 24, 24), 4, ratio);
    paint_ring(painter, at, 4 * ratio, lamp_colour, 1.5, ratio);
}

void paint_arrow(QPainter& painter, QPointF from, QPointF to, const QColor& colour, bool is_held,
                 qreal ratio) {
    paint_line(painter, {from, to}, colour, is_held ? 3 : 2, ratio);
    const QPointF along = to - from;
    const qreal length = std::hypot(along.x(), along.y());
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

void paint_handle(QPainter& painter, const Grip& grip, LightHandle handle, bool is_held, bool dots,
                  qreal ratio) {
    const bool is_axis = handle != LightHandle::centre && handle != LightHandle::direction;
    const QColor colour = is_held && !is_axis ? QColor(Qt::white) : colour_of(handle);
    const qreal width = is_held ? 3 : 2;
    if (handle == LightHandle::centre) {
        if (dots) paint_dot(painter, grip.centre, colour, is_held ? 8 : 6.5, ratio);
    } else if (is_axis) {
        if (dots) return;
        paint_arrow(painter, grip.centre, grip.end, colour, is_held, ratio);
        paint_letter(painter, grip.centre, grip.end, handle, ratio);
    } else if (grip.ring > 0) {
        if (dots) paint_ring(painter, grip.centre, grip.ring, colour, width, ratio);
    } else if (dots) {
        paint_dot(painter, grip.end, colour, is_held ? 6.5 : 5, ratio);
    } else {
        paint_line(painter, {grip.centre, grip.end}, lamp_colour, width, ratio);
    }
}

}  // namespace

void paint_light(QPainter& painter, const CanvasState& state, qreal ratio) {
    const auto centre = seen_at(state, state.light->position);
    if (!centre) return;
    painter.save();
    paint_outline(painter, state, handle_length(state, ratio), ratio);
    auto handles = handles_of(*state.light);
    std::reverse(handles.begin(), handles.end());
    // What is a dot lies above all lines.
    for (const bool dots : {false, true}) {
        for (const auto handle : handles)
            if (const auto grip = grip_of(state, handle, ratio))
                paint_handle(painter, *grip, handle, handle == state.light_handle, dots, ratio);
        if (!dots && !state.light->moves()) paint_foot(painter, *centre, ratio);
    }
    painter.restore();
}

}  // namespace ir::widgets
