#include "widgets/plot/plot_style.h"

#include <QPainter>
#include <QPolygonF>
#include <cmath>
#include <numbers>

namespace ir::widgets {
namespace {

/// A regular polygon or, with `inner` below 1, a star; the first corner at `start` turns from the top.
QPolygonF polygon(int corners, double start, double inner, const QPointF& centre, double radius) {
    constexpr double pi = std::numbers::pi;
    QPolygonF shape;
    const int count = inner < 1 ? 2 * corners : corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * (start + double(i) / count);
        const double r = radius * (inner < 1 && i % 2 == 1 ? inner : 1);
        shape << centre + QPointF(std::sin(angle), -std::cos(angle)) * r;
    }
    return shape;
}

/// The marks that follow the circle: as polygon() takes them, and how large they are for equal weight.
constexpr struct {
    int corners;
    double start, inner, size;
} polygons[] = {{4, 0.125, 1, 1.2}, {3, 0, 1, 1.35}, {4, 0, 1, 1.3},  {3, 0.5, 1, 1.35},
                {5, 0, 0.45, 1.5},  {6, 0, 1, 1.15}, {4, 0, 0.4, 1.5}};

}  // namespace

// Eight hues that people with any colour vision can tell apart [Okabe08], black exchanged for light grey on
// the dark ground and yellow darkened on the white one.
const PlotStyle& PlotStyle::screen() {
    static const PlotStyle style{
        QColor(36, 36, 36),
        QColor(222, 222, 222),
        QColor(160, 160, 160),
        QColor(62, 62, 62),
        QColor(240, 240, 240),
        QColor(176, 176, 176),
        Qt::white,
        {QColor(86, 180, 233), QColor(230, 159, 0), QColor(0, 178, 132), QColor(240, 228, 66),
         QColor(232, 104, 22), QColor(204, 121, 167), QColor(74, 134, 208), QColor(200, 200, 200)}};
    return style;
}

const PlotStyle& PlotStyle::paper() {
    static const PlotStyle style{
        Qt::white,
        QColor(20, 20, 20),
        QColor(80, 80, 80),
        QColor(218, 218, 218),
        QColor(40, 40, 40),
        QColor(90, 90, 90),
        Qt::black,
        {QColor(0, 114, 178), QColor(213, 94, 0), QColor(0, 158, 115), QColor(178, 142, 0),
         QColor(86, 180, 233), QColor(180, 84, 136), QColor(230, 159, 0), QColor(90, 90, 90)}};
    return style;
}

void draw_mark(QPainter& painter, const QPointF& centre, int series, double radius, const PlotStyle& style,
               bool hollow) {
    painter.setPen(hollow ? QPen(style.series(series), 1.5) : QPen(style.background, 1));
    painter.setBrush(hollow ? style.background : style.series(series));
    // Once the colours are used up, the same ones come with other shapes.
    const int colours = int(style.colours.size());
    const int shape = (series + series / colours) % (1 + int(std::size(polygons)));
    if (shape == 0) return painter.drawEllipse(centre, radius, radius);
    const auto& [corners, start, inner, size] = polygons[shape - 1];
    painter.drawPolygon(polygon(corners, start, inner, centre, size * radius));
}

}  // namespace ir::widgets
