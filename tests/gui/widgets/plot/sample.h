#pragma once

#include <QApplication>
#include <QColor>
#include <QImage>
#include <QTest>
#include <cstdlib>

#include "renderers/plot/plot_data.h"
#include "renderers/plot/plot_scale.h"

namespace ir::widgets {

inline PlotPoint sample_point(const std::string& id, double x, double y, bool ring = false) {
    PlotPoint point;
    point.id = id;
    point.x = x;
    point.y = y;
    point.ring = ring;
    point.label = "point " + id + "\n" + plot_number(x) + " ms";
    point.cells = {{id}, {plot_number(x), x}, {plot_number(y), y}};
    return point;
}

/// Two series over four decades of time.
inline PlotData sample_plot() {
    PlotData data;
    data.title = "Error over directions";
    data.x = {"Time of rendering (ms)", true, {}, {}};
    data.y = {"RMSE", true, {}, {}};
    data.series = {{"fast",
                    {sample_point("f1", 1, 0.2, true), sample_point("f2", 10, 0.1, true),
                     sample_point("f3", 100, 0.08)}},
                   {"good", {sample_point("g1", 90, 0.05, true), sample_point("g2", 2000, 0.004, true)}}};
    data.ring_name = "front";
    data.join_rings = true;
    data.level = PlotLevel{0.002, "reference's own noise"};
    data.headings = {"Name", "ms", "RMSE"};
    return data;
}

/// Pixels that clearly have the hue of a colour.
inline int count_like(const QImage& image, const QColor& colour, const QRect& area) {
    int count = 0;
    for (int y = area.top(); y <= area.bottom(); ++y)
        for (int x = area.left(); x <= area.right(); ++x) {
            if (!image.rect().contains(x, y)) continue;
            const QColor pixel = image.pixelColor(x, y);
            if (std::abs(pixel.red() - colour.red()) + std::abs(pixel.green() - colour.green()) +
                    std::abs(pixel.blue() - colour.blue()) <
                40)
                ++count;
        }
    return count;
}

}  // namespace ir::widgets
