#include "widgets/plot/plot_marks.h"

#include <QPainter>

#include <QPolygonF>
#include "widgets/style/theme.h"

namespace ir::widgets {

const PlotStyle& window_style() {
    return theme() == Theme::dark ? PlotStyle::screen() : PlotStyle::paper();
}

void draw_mark(QPainter& painter, const QPointF& centre, int series, double radius, const PlotStyle& style,
               bool hollow) {
    const auto colour = colour_of(style.series(series)), ground = colour_of(style.background);
    painter.setPen(hollow ? QPen(colour, 1.5) : QPen(ground, 1));
    painter.setBrush(hollow ? ground : colour);
    QPolygonF outline;
    for (const auto& [x, y] : mark_corners(series)) outline << centre + QPointF(x, y) * radius;
    if (outline.isEmpty()) return painter.drawEllipse(centre, radius, radius);
    painter.drawPolygon(outline);
}

}  // namespace ir::widgets
