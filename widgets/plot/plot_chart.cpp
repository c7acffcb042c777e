#include "widgets/plot/plot_chart.h"

#include <QApplication>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ir::widgets {
namespace {

constexpr int rings_entry = -1, rest_entry = -2;  ///< of the legend, in place of a series
constexpr double gap = 6;                         ///< between axes, ticks and titles
constexpr double right_margin = 22;               ///< half of a tick's text stands there
/// Of the axes, below which the legend gets no further line.
constexpr double min_plot_height = 56;

}  // namespace

PlotChart::PlotChart(const PlotStyle& style)
    : style_(style), placed_(place_plot({}, 0, 0)), font_(QApplication::font()), title_font_(font_) {
    title_font_.setBold(true);
}

const PlotChart::Mark* PlotChart::mark(const QString& id) const {
    const auto wanted = id.toStdString();
    const auto found =
        std::find_if(marks().begin(), marks().end(), [&](const Mark& each) { return each.id == wanted; });
    return id.isEmpty() || found == marks().end() ? nullptr : &*found;
}

double PlotChart::x_at(double place) const {
    return area_.left() + (place - placed_.x.low()) / (placed_.x.high() - placed_.x.low()) * area_.width();
}

double PlotChart::y_at(double place) const {
    return area_.bottom() - (place - placed_.y.low()) / (placed_.y.high() - placed_.y.low()) * area_.height();
}

QPointF PlotChart::position(const Mark& mark) const {
    return {x_at(mark.x), y_at(mark.y)};
}

void PlotChart::set_data(const PlotData& data) {
    data_ = data;
    rebuild();
    if (!mark(selected_)) selected_.clear();
    if (!mark(hovered_)) hovered_.clear();
}

void PlotChart::set_size(const QSizeF& size) {
    size_ = size;
    rebuild();
}

bool PlotChart::set_hovered(const QString& id) {
    return std::exchange(hovered_, id) != id;
}

void PlotChart::rebuild() {
    placed_ = place_plot(data_, size_.width() - 80, size_.height() - 90);
    const QFontMetricsF metrics(font_);
    double widest = 0;
    for (const auto& tick : placed_.y.ticks())
        widest = std::max(widest, metrics.horizontalAdvance(QString::fromStdString(tick.text)));
    const double top = lay_out_legend(), left = metrics.height() + widest + 3 * gap;
    const double bottom = size_.height() - 2 * metrics.height() - 2 * gap;
    area_ = QRectF(QPointF(left, top + gap), QPointF(std::max(left + 1, size_.width() - right_margin),
                                                     std::max(top + gap + 1, bottom)));
}

/// Entries after one another, below the title, in as many lines as they need and the axes leave;
/// returns where they end.
double PlotChart::lay_out_legend() {
    const QFontMetricsF metrics(font_);
    const double line = metrics.height() + 4, width = std::max(120.0, size_.width() - 24);
    const double top = data_.title.empty() ? 8 : 10 + QFontMetricsF(title_font_).height() + 4;
    const double lowest = size_.height() - 2 * line - 2 * gap - min_plot_height;
    legend_.clear();
    double x = 12, y = top;
    int rest = 0;
    const auto add = [&](const QString& text, int series) {
        const QString shown = metrics.elidedText(text, Qt::ElideMiddle, width - 40);
        const double needed = 32 + metrics.horizontalAdvance(shown) + 18;
        const bool is_full = x > 12 && x + needed - 18 > width + 12;
        if (rest > 0 || (is_full && y + 2 * line > lowest)) {
            ++rest;
            return;
        }
        if (is_full) x = 12, y += line;
        legend_.push_back({shown, series, {x, y + line / 2}});
        x += needed;
    };
    if (is_heat()) add(QString::fromStdString(data_.heat->title), rest_entry);
    for (std::size_t s = 0; s < data_.series.size() && !is_heat(); ++s)
        add(QString::fromStdString(data_.series[s].name), int(s));
    if (placed_.has_rings() && !data_.ring_name.empty())
        add(QString::fromStdString(data_.ring_name), rings_entry);
    if (rest > 0) {
        const auto text = [&] { return tr("and %1 more").arg(rest); };
        for (; x > 12 && x + metrics.horizontalAdvance(text()) > width + 12; ++rest) {
            x = legend_.back().at.x();
            legend_.pop_back();
        }
        legend_.push_back({text(), rest_entry, {x, y + line / 2}});
    }
    return legend_.empty() ? top : y + line;
}

QRectF PlotChart::x_title() const {
    const QFontMetricsF metrics(font_);
    return {area_.left(), size_.height() - metrics.height() - gap / 2, area_.width(), metrics.height()};
}

QRectF PlotChart::y_title() const {
    return {gap / 2, area_.top(), QFontMetricsF(font_).height(), area_.height()};
}

void PlotChart::paint_axes(QPainter& painter) const {
    const QFontMetricsF metrics(font_);
    painter.setFont(font_);
    const auto line = [&](const QPointF& from, const QPointF& to, const PlotColour& colour) {
        painter.setPen(QPen(colour_of(colour), 1));
        painter.drawLine(from, to);
    };
    for (const auto& tick : placed_.y.ticks()) {
        const double y = y_at(tick.place);
        line({area_.left(), y}, {area_.right(), y}, style_.grid);
        painter.setPen(colour_of(style_.text));
        painter.drawText(QRectF(0, y - metrics.height() / 2, area_.left() - gap, metrics.height()),
                         Qt::AlignRight | Qt::AlignVCenter, QString::fromStdString(tick.text));
    }
    const auto& ticks = placed_.x.ticks();
    const double room = data_.x.names.empty() ? 0 : area_.width() / std::max<double>(1, double(ticks.size()));
    for (const auto& tick : ticks) {
        const double x = x_at(tick.place);
        line({x, area_.top()}, {x, area_.bottom()}, style_.grid);
        auto text = QString::fromStdString(tick.text);
        if (room > 0) text = metrics.elidedText(text, Qt::ElideRight, room);
        const double width = metrics.horizontalAdvance(text) + 2;
        painter.setPen(colour_of(style_.text));
        painter.drawText(QRectF(x - width / 2, area_.bottom() + gap / 2, width, metrics.height()),
                         Qt::AlignCenter, text);
    }
    line(area_.bottomLeft(), area_.bottomRight(), style_.dim);
    line(area_.topLeft(), area_.bottomLeft(), style_.dim);
    painter.setPen(colour_of(style_.text));
    painter.drawText(
        x_title(), Qt::AlignCenter,
        metrics.elidedText(QString::fromStdString(data_.x.title), Qt::ElideRight, area_.width()));
    const auto upright = y_title();
    painter.save();
    painter.translate(upright.center());
    painter.rotate(-90);
    painter.drawText(
        QRectF(-upright.height() / 2, -upright.width() / 2, upright.height(), upright.width()),
        Qt::AlignCenter,
        metrics.elidedText(QString::fromStdString(data_.y.title), Qt::ElideRight, upright.height()));
    painter.restore();
}

void PlotChart::paint_lines(QPainter& painter) const {
    painter.setBrush(Qt::NoBrush);
    const auto draw = [&](const Points& points, const QPen& pen) {
        painter.setPen(pen);
        painter.drawPolyline(points.data(), int(points.size()));
    };
    Points line, front;
    for (std::size_t i = 0; i < marks().size(); ++i) {
        const auto& mark = marks()[i];
        line.push_back(position(mark));
        if (mark.ring) front.push_back(position(mark));
        if (i + 1 < marks().size() && !marks()[i + 1].begins) continue;
        QColor colour = colour_of(style_.series(mark.series));
        colour.setAlphaF(0.75f);
        draw(std::exchange(line, {}), QPen(colour, 1.5));
    }
    std::sort(front.begin(), front.end(), [](const QPointF& a, const QPointF& b) { return a.x() < b.x(); });
    QPen pen(colour_of(style_.front), 1.2);
    pen.setDashPattern({2, 3});
    if (data_.join_rings && front.size() > 1) draw(front, pen);
    if (!placed_.shows_level) return;
    QPen dashes(colour_of(style_.level), 1.2);
    dashes.setDashPattern({7, 4});
    const double y = y_at(placed_.y.place(data_.level->y));
    draw({{area_.left(), y}, {area_.right(), y}}, dashes);
}

void PlotChart::paint(QPainter& painter) const {
    painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    painter.fillRect(QRectF(QPointF(), size_), colour_of(style_.background));
    if (size_.isEmpty()) return;
    paint_axes(painter);
    paint_header(painter);
    if (marks().empty()) return;
    painter.save();
    painter.setClipRect(area_.adjusted(-9, -9, 9, 9));
    if (is_heat()) {
        paint_tiles(painter);
    } else {
        paint_lines(painter);
        paint_level(painter);
        paint_points(painter);
    }
    painter.restore();
}

void PlotChart::paint_header(QPainter& painter) const {
    painter.setPen(colour_of(style_.text));
    painter.setFont(title_font_);
    const QFontMetricsF bold(title_font_);
    painter.drawText(
        QRectF(12, 8, size_.width() - 24, bold.height() + 2), Qt::AlignLeft | Qt::AlignTop,
        bold.elidedText(QString::fromStdString(data_.title), Qt::ElideRight, size_.width() - 24));
    painter.setFont(font_);
    if (is_heat()) return paint_heat_legend(painter);
    const QFontMetricsF metrics(font_);
    for (const auto& entry : legend_) {
        const double baseline = entry.at.y() + (metrics.ascent() - metrics.descent()) / 2;
        if (entry.series == rest_entry) {
            painter.setPen(colour_of(style_.dim));
            painter.drawText(QPointF(entry.at.x(), baseline), entry.text);
            continue;
        }
        const QPointF centre = entry.at + QPointF(12, 0);
        const bool is_series = entry.series != rings_entry;
        QPen pen(is_series ? colour_of(style_.series(entry.series)) : colour_of(style_.front), 1.5);
        if (!is_series) pen.setDashPattern({2, 3});
        painter.setPen(pen);
        if (is_series || data_.join_rings) painter.drawLine(centre - QPointF(12, 0), centre + QPointF(12, 0));
        if (is_series) {
            draw_mark(painter, centre, entry.series, 4.5, style_);
        } else {
            painter.setPen(QPen(colour_of(style_.front), 1.5));
            painter.setBrush(colour_of(style_.background));
            painter.drawEllipse(centre, 6, 6);
        }
        painter.setPen(colour_of(style_.text));
        painter.drawText(QPointF(centre.x() + 18, baseline), entry.text);
    }
}

void PlotChart::paint_level(QPainter& painter) const {
    if (!placed_.shows_level) return;
    const QFontMetricsF metrics(font_);
    const QString text =
        metrics.elidedText(QString::fromStdString(data_.level->label), Qt::ElideRight, area_.width() - 16);
    const double width = metrics.horizontalAdvance(text), y = y_at(placed_.y.place(data_.level->y));
    const bool above = y - metrics.height() - 2 > area_.top();
    painter.setFont(font_);
    painter.setPen(colour_of(style_.dim));
    painter.drawText(QPointF(area_.right() - width - 6, above ? y - 5 : y + metrics.ascent() + 4), text);
}

QRectF PlotChart::tile(const Mark& mark) const {
    Mark low = mark, high = mark;
    low.x -= 0.5, low.y -= 0.5;
    high.x += 0.5, high.y += 0.5;
    return QRectF(position(low), position(high)).normalized();
}

bool PlotChart::is_in_tile(const Mark& mark, const QPointF& place) const {
    return tile(mark).contains(place);
}

/// The colours with the least and the greatest value, and what they stand for.
void PlotChart::paint_heat_legend(QPainter& painter) const {
    if (legend_.empty()) return;
    constexpr int width = 120, steps = 24;
    const auto& heat = *placed_.heat;
    const QFontMetricsF metrics(font_);
    const auto low = QString::fromStdString(plot_number(heat.low)),
               high = QString::fromStdString(plot_number(heat.high));
    const double middle = legend_.front().at.y(),
                 baseline = middle + (metrics.ascent() - metrics.descent()) / 2,
                 left = 12 + metrics.horizontalAdvance(low) + 6;
    for (int i = 0; i < steps; ++i)
        painter.fillRect(
            QRectF(left + double(i) * width / steps, middle - 6, double(width) / steps + 0.5, 12),
            colour_of(heat.colour(heat.at((i + 0.5) / steps))));
    painter.setPen(colour_of(style_.text));
    painter.drawText(QPointF(12, baseline), low);
    painter.drawText(QPointF(left + width + 6, baseline), high + QStringLiteral("  ") + legend_.front().text);
}

void PlotChart::paint_tiles(QPainter& painter) const {
    painter.setFont(font_);
    for (const auto& mark : marks()) {
        const auto box = tile(mark);
        painter.fillRect(box, colour_of(placed_.heat->colour(mark.value)));
        if (box.width() < min_tile_width || box.height() < min_tile_height) continue;
        painter.setPen(colour_of(placed_.heat->ink(mark.value)));
        painter.drawText(box, Qt::AlignCenter, QString::fromStdString(plot_number(mark.value)));
    }
    painter.setBrush(Qt::NoBrush);
    const auto frame = [&](const QString& id, double width) {
        const auto* chosen = mark(id);
        if (!chosen) return;
        painter.setPen(QPen(colour_of(style_.background), width + 2));
        painter.drawRect(tile(*chosen).adjusted(1, 1, -1, -1));
        painter.setPen(QPen(colour_of(style_.selection), width));
        painter.drawRect(tile(*chosen).adjusted(1, 1, -1, -1));
    };
    frame(hovered_, 1);
    frame(selected_, 2.5);
}

void PlotChart::paint_points(QPainter& painter) const {
    const double size = mark_radius(marks().size());
    const auto ring = [&](const Mark& mark, double radius, const QPen& pen) {
        painter.setPen(pen);
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(position(mark), radius, radius);
    };
    for (const auto& mark : marks()) {
        if (!mark.shown) continue;
        draw_mark(painter, position(mark), mark.series, size, style_, mark.displaced);
        if (mark.ring) ring(mark, size + 3, QPen(colour_of(style_.front), 1.5));
    }
    if (const auto* hovered = mark(hovered_)) {
        draw_mark(painter, position(*hovered), hovered->series, size + 2, style_, hovered->displaced);
        if (hovered->ring) ring(*hovered, size + 5, QPen(colour_of(style_.front), 1.5));
    }
    if (const auto* selected = mark(selected_)) {
        draw_mark(painter, position(*selected), selected->series, size + 1.5, style_, selected->displaced);
        ring(*selected, size + 7, QPen(colour_of(style_.selection), 2.5));
    }
}

QImage plot_picture(const PlotData& data, const QSize& size, double scale, const PlotStyle& style) {
    PlotChart chart(style);
    chart.set_size(size);
    chart.set_data(data);
    QImage image((QSizeF(size) * scale).toSize(), QImage::Format_RGB32);
    image.fill(colour_of(style.background));
    QPainter painter(&image);
    painter.scale(scale, scale);
    chart.paint(painter);
    return image;
}

}  // namespace ir::widgets
