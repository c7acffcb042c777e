#include "widgets/image/region_overlay.h"

#include <QFontMetricsF>
#include <cmath>

namespace ir::widgets {
namespace {

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

void paint_size(QPainter& painter, const CanvasState& state, const QRectF& box, qreal ratio) {
    const QString text =
        QStringLiteral("%1 × %2").arg(state.marks.region.width()).arg(state.marks.region.height());
    QFont font = painter.font();
    font.setPixelSize(std::max(1, int(11 * ratio)));
    painter.setFont(font);
    const QFontMetricsF metrics(font);
    const QSizeF plate(metrics.horizontalAdvance(text) + 8 * ratio, metrics.height() + 2 * ratio);
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

}  // namespace

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
        paint_size(painter, state, box, ratio);
    }
    painter.restore();
}

}  // namespace ir::widgets
