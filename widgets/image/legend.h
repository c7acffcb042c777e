#pragma once

#include <QPainter>
#include <vector>

#include "widgets/image/prepared_picture.h"

namespace ir::widgets {

/// What colours mean: a bar with numbers and unit (or exposure and tone map), and the marks that are on.
/// Lengths are device pixels. What is higher than `room` loses first the marks, then length of its bar.
QSizeF legend_size(const PreparedPicture& picture, qreal pixel_ratio, qreal room);
void paint_legend(QPainter& painter, const PreparedPicture& picture, QPointF top_left, qreal pixel_ratio,
                  qreal room);

/// The same in one line, for views in which a column would leave less of the picture. What has no room is
/// left out from the right.
qreal legend_line_height(qreal pixel_ratio);
void paint_legend_line(QPainter& painter, const PreparedPicture& picture, const QRectF& row,
                       qreal pixel_ratio);
/// Whether it has anything to say.
bool has_legend(const PreparedPicture& picture);

/// Both ends and round numbers between them, at most `count` in all, ascending.
std::vector<double> legend_ticks(double low, double high, int count);

}  // namespace ir::widgets
