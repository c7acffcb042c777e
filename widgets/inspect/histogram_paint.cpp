#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "widgets/image/display.h"
#include "widgets/inspect/histogram_view.h"
#include "widgets/style/theme.h"

/// How the histogram is drawn.
namespace ir::widgets {
namespace {

QColor channel_colour(int channel, std::size_t channels) {
    if (channels == 1) return {190, 190, 190};
    const QColor colours[] = {{225, 70, 60}, {70, 190, 70}, {70, 120, 240}, {150, 150, 150}};
    return colours[std::size_t(channel) % std::size(colours)];
}

double height_of(std::uint64_t count, bool logarithmic) {
    return logarithmic ? std::log1p(double(count)) : double(count);
}

QPainterPath bars(const std::array<std::uint64_t, Histogram::bins>& counts, const QRectF& box, double highest,
                  bool logarithmic) {
    QPainterPath path(box.bottomLeft());
    const double width = box.width() / Histogram::bins;
    const auto full = [](std::uint64_t count) { return count > 0; };
    // A lone bin would be too thin to see.
    const double room = std::count_if(counts.begin(), counts.end(), full) == 1 ? 2 : 0;
    for (std::size_t bin = 0; bin < counts.size(); ++bin) {
        if (room > 0 && counts[bin] == 0) continue;
        const double y = box.bottom() - height_of(counts[bin], logarithmic) / highest * box.height();
        const double left = box.left() + double(bin) * width - room;
        const double right = box.left() + double(bin + 1) * width + room;
        if (room > 0) path.lineTo(left, box.bottom());
        path.lineTo(left, y);
        path.lineTo(right, y);
        if (room > 0) path.lineTo(right, box.bottom());
    }
    path.lineTo(box.bottomRight());
    path.closeSubpath();
    return path;
}

}  // namespace

void HistogramView::paint_bars(QPainter& painter) const {
    const QRectF box = plot();
    std::uint64_t highest = 0;
    for (const auto& counts : histogram_.counts)
        highest = std::max(highest, *std::max_element(counts.begin(), counts.end()));
    if (highest == 0) return;
    painter.save();
    painter.setPen(Qt::NoPen);
    painter.setOpacity(counted_ ? 1 : 0.5);
    // Where channels overlap, light adds up on a dark ground, and ink on a light one.
    const bool is_dark = theme() == Theme::dark;
    if (histogram_.counts.size() > 1)
        painter.setCompositionMode(is_dark ? QPainter::CompositionMode_Plus
                                           : QPainter::CompositionMode_Multiply);
    for (std::size_t c = 0; c < histogram_.counts.size(); ++c) {
        QColor colour = channel_colour(histogram_.channels[c], histogram_.counts.size());
        if (histogram_.counts.size() > 1) colour = is_dark ? colour.darker(190) : colour.lighter(115);
        painter.setBrush(colour);
        painter.drawPath(bars(histogram_.counts[c], box, height_of(highest, logarithmic_), logarithmic_));
    }
    painter.restore();
}

void HistogramView::paint_handles(QPainter& painter) const {
    const QRectF box = plot();
    const auto shade_beyond = [&](double from, double to) {
        if (to > from)
            painter.fillRect(QRectF(from, box.top(), to - from, box.height()), QColor(0, 0, 0, 110));
    };
    const double left = handle_x(std::min(low_, high_)), right = handle_x(std::max(low_, high_));
    shade_beyond(box.left(), left);
    shade_beyond(right, box.right());
    const auto paint = [&](Handle handle, double value) {
        const double x = handle_x(value);
        const bool active = hasFocus() && active_ == handle;
        const QColor colour = active ? palette().color(QPalette::Link) : palette().color(QPalette::Text);
        painter.setPen(QPen(colour, active ? 2 : 1));
        painter.drawLine(QPointF(x, box.top()), QPointF(x, box.bottom()));
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        const double size = 5;
        QPolygonF arrow;
        if (x_of(value) < box.left() - 0.5)  // beyond the axis: points there
            arrow << QPointF(x - size - 2, box.center().y()) << QPointF(x, box.center().y() - size)
                  << QPointF(x, box.center().y() + size);
        else if (x_of(value) > box.right() + 0.5)
            arrow << QPointF(x + size + 2, box.center().y()) << QPointF(x, box.center().y() - size)
                  << QPointF(x, box.center().y() + size);
        else
            arrow << QPointF(x, box.bottom() - size) << QPointF(x - size, box.bottom() + 2)
                  << QPointF(x + size, box.bottom() + 2);
        painter.drawPolygon(arrow);
    };
    paint(Handle::low, low_);
    paint(Handle::high, high_);
}

void HistogramView::paint_labels(QPainter& painter) const {
    const QRectF box = plot();
    const QRectF line(box.left() - 4, box.bottom() + 3, box.width() + 8, height() - box.bottom() - 3);
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(line, Qt::AlignLeft | Qt::AlignTop, short_number(histogram_.axis.low));
    painter.drawText(line, Qt::AlignRight | Qt::AlignTop, short_number(histogram_.axis.high));
    // Zero is where signed quantities turn over.
    if (histogram_.axis.low >= 0 || histogram_.axis.high <= 0) return;
    const double zero = x_of(0);
    painter.setPen(QPen(theme_colours().dim, 1, Qt::DotLine));
    painter.drawLine(QPointF(zero, box.top()), QPointF(zero, box.bottom()));
    if (zero < line.left() + 60 || zero > line.right() - 60) return;
    painter.drawText(QRectF(zero - 20, line.top(), 40, line.height()), Qt::AlignHCenter | Qt::AlignTop,
                     QStringLiteral("0"));
}

void HistogramView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box = plot();
    painter.fillRect(box, palette().color(QPalette::Base));
    painter.setPen(palette().color(QPalette::PlaceholderText));
    if (!picture_) return void(painter.drawText(box, Qt::AlignCenter, tr("No image")));
    if (counted_ && histogram_.finite == 0)
        return void(painter.drawText(box, Qt::AlignCenter, tr("No finite values")));
    paint_bars(painter);
    paint_labels(painter);
    if (range_shown_) paint_handles(painter);
    if (counted_) return;
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(box.adjusted(6, 4, -6, -4), Qt::AlignRight | Qt::AlignTop, tr("counting …"));
}

}  // namespace ir::widgets
