#pragma once

#include <QColor>
#include <QPointF>

#include "renderers/plot/plot_style.h"

class QPainter;

namespace ir::widgets {

inline QColor colour_of(const PlotColour& colour) {
    return QColor(QLatin1String(colour.c_str()));
}

/// That goes with the window's theme.
const PlotStyle& window_style();

/// The mark of a series, `radius` pixels large. Hollow marks stand at an end of an axis on which their value
/// has no place.
void draw_mark(QPainter& painter, const QPointF& centre, int series, double radius, const PlotStyle& style,
               bool hollow = false);

}  // namespace ir::widgets
