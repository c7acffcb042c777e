#include "widgets/plot/plot_chart.h"

#include <QApplication>
#include <QCategoryAxis>
#include <QGraphicsLayout>
#include <QGraphicsScene>
#include <QGraphicsSceneResizeEvent>
#include <QLineSeries>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ir::widgets {
namespace {

/// Of the height below the legend: what Qt Charts gives to the axis below at most. It cuts the title off
/// then.
constexpr double axis_share = 0.4;
constexpr int rings_entry = -1, rest_entry = -2;  ///< of the legend, in place of a series

/// Stands above axes and lines; the chart paints.
class Painted : public QGraphicsItem {
  public:
    explicit Painted(PlotChart& chart) : QGraphicsItem(&chart), chart_(chart) { setZValue(1000); }
    QRectF boundingRect() const override { return QRectF(QPointF(), chart_.size()); }
    void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override {
        painter->setRenderHint(QPainter::Antialiasing);
        chart_.paint_marks(*painter);
    }
    void grow() { prepareGeometryChange(); }

  private:
    PlotChart& chart_;
};

}  // namespace

PlotChart::PlotChart(const PlotStyle& style, QGraphicsItem* parent)
    : QChart(parent),
      style_(style),
      placed_(place_plot({}, 0, 0)),
      font_(QApplication::font()),
      title_font_(font_),
      painted_(new Painted(*this)) {
    title_font_.setBold(true);
    setAnimationOptions(NoAnimation);
    setBackgroundBrush(colour_of(style.background));
    setBackgroundPen(Qt::NoPen);
    setBackgroundRoundness(0);
    legend()->hide();
    x_axis_ = make_axis(Qt::AlignBottom);
    y_axis_ = make_axis(Qt::AlignLeft);
    connect(this, &QChart::plotAreaChanged, this, [this] { painted_->update(); });
}

const PlotChart::Mark* PlotChart::mark(const QString& id) const {
    const auto wanted = id.toStdString();
    const auto found =
        std::find_if(marks().begin(), marks().end(), [&](const Mark& each) { return each.id == wanted; });
    return id.isEmpty() || found == marks().end() ? nullptr : &*found;
}

double PlotChart::y_at(double place) const {
    const QRectF area = plotArea();
    return area.bottom() - (place - placed_.y.low()) / (placed_.y.high() - placed_.y.low()) * area.height();
}

QPointF PlotChart::position(const Mark& mark) const {
    const QRectF area = plotArea();
    return {area.left() + (mark.x - placed_.x.low()) / (placed_.x.high() - placed_.x.low()) * area.width(),
            y_at(mark.y)};
}

void PlotChart::set_data(const PlotData& data) {
    data_ = data;
    rebuild();
    if (!mark(selected_)) selected_.clear();
    if (!mark(hovered_)) hovered_.clear();
}

void PlotChart::set_selected(const QString& id) {
    selected_ = id;
    painted_->update();
}

void PlotChart::set_hovered(const QString& id) {
    if (hovered_ == id) return;
    hovered_ = id;
    painted_->update();
}

void PlotChart::resizeEvent(QGraphicsSceneResizeEvent* event) {
    QChart::resizeEvent(event);
    static_cast<Painted*>(painted_)->grow();
    rebuild();
}

void PlotChart::rebuild() {
    placed_ = place_plot(data_, size().width() - 80, size().height() - 90);
    lay_out_legend();
    removeAllSeries();
    show_axis(*x_axis_, placed_.x, data_.x);
    show_axis(*y_axis_, placed_.y, data_.y);
    make_lines();
    painted_->update();
}

/// Entries after one another, below the title, in as many lines as they need and the axes leave.
void PlotChart::lay_out_legend() {
    const QFontMetricsF metrics(font_);
    const double line = metrics.height() + 4, width = std::max(120.0, size().width() - 24);
    const double top = data_.title.empty() ? 8 : 10 + QFontMetricsF(title_font_).height() + 4;
    const double lowest = size().height() - (2 * line + 6) / axis_share - 24;
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
    const double bottom = legend_.empty() ? top : y + line;
    setMargins(QMargins(6, int(std::ceil(bottom)) + 4, 16, 2));
}

QCategoryAxis* PlotChart::make_axis(Qt::Alignment side) {
    auto* made = new QCategoryAxis;
    made->setLabelsPosition(QCategoryAxis::AxisLabelsPositionOnValue);
    made->setLinePen(QPen(colour_of(style_.dim), 1));
    made->setGridLinePen(QPen(colour_of(style_.grid), 1));
    made->setLabelsFont(font_);
    made->setLabelsBrush(colour_of(style_.text));
    made->setTitleFont(font_);
    made->setTitleBrush(colour_of(style_.text));
    addAxis(made, side);
    return made;
}

void PlotChart::show_axis(QCategoryAxis& shown, const PlotScale& scale, const PlotAxis& axis) {
    for (const auto& label : shown.categoriesLabels()) shown.remove(label);
    shown.setStartValue(scale.low() - (scale.high() - scale.low()));
    for (const auto& tick : scale.ticks()) shown.append(QString::fromStdString(tick.text), tick.place);
    shown.setRange(scale.low(), scale.high());
    shown.setTruncateLabels(!axis.names.empty());
    shown.setTitleText(QString::fromStdString(axis.title));
}

void PlotChart::add_line(const std::vector<QPointF>& points, const QPen& pen) {
    auto* line = new QLineSeries;
    line->append(QList<QPointF>(points.begin(), points.end()));
    line->setPen(pen);
    addSeries(line);
    line->attachAxis(x_axis_);
    line->attachAxis(y_axis_);
}

void PlotChart::make_lines() {
    if (is_heat()) return;
    std::vector<QPointF> line, front;
    for (std::size_t i = 0; i < marks().size(); ++i) {
        const auto& mark = marks()[i];
        line.push_back({mark.x, mark.y});
        if (mark.ring) front.push_back({mark.x, mark.y});
        if (i + 1 < marks().size() && !marks()[i + 1].begins) continue;
        QColor colour = colour_of(style_.series(mark.series));
        colour.setAlphaF(0.75f);
        add_line(std::exchange(line, {}), QPen(colour, 1.5));
    }
    std::sort(front.begin(), front.end(), [](const QPointF& a, const QPointF& b) { return a.x() < b.x(); });
    QPen pen(colour_of(style_.front), 1.2);
    pen.setDashPattern({2, 3});
    if (data_.join_rings && front.size() > 1) add_line(front, pen);
    if (placed_.shows_level && !marks().empty()) {
        QPen dashes(colour_of(style_.level), 1.2);
        dashes.setDashPattern({7, 4});
        const double y = placed_.y.place(data_.level->y);
        add_line({{placed_.x.low(), y}, {placed_.x.high(), y}}, dashes);
    }
}

void PlotChart::paint_marks(QPainter& painter) const {
    paint_header(painter);
    if (marks().empty()) return;
    painter.save();
    painter.setClipRect(plotArea().adjusted(-9, -9, 9, 9));
    if (is_heat()) {
        paint_tiles(painter);
        return painter.restore();
    }
    paint_level(painter);
    paint_points(painter);
    painter.restore();
}

void PlotChart::paint_header(QPainter& painter) const {
    painter.setPen(colour_of(style_.text));
    painter.setFont(title_font_);
    const QFontMetricsF bold(title_font_);
    painter.drawText(
        QRectF(12, 8, size().width() - 24, bold.height() + 2), Qt::AlignLeft | Qt::AlignTop,
        bold.elidedText(QString::fromStdString(data_.title), Qt::ElideRight, size().width() - 24));
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
    const QRectF area = plotArea();
    const QFontMetricsF metrics(font_);
    const QString text =
        metrics.elidedText(QString::fromStdString(data_.level->label), Qt::ElideRight, area.width() - 16);
    const double width = metrics.horizontalAdvance(text), y = y_at(placed_.y.place(data_.level->y));
    const bool above = y - metrics.height() - 2 > area.top();
    painter.setFont(font_);
    painter.setPen(colour_of(style_.dim));
    painter.drawText(QPointF(area.right() - width - 6, above ? y - 5 : y + metrics.ascent() + 4), text);
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
    QGraphicsScene scene;
    auto* chart = new PlotChart(style);
    scene.addItem(chart);
    chart->resize(size);
    chart->set_data(data);
    chart->layout()->activate();
    const QRectF area(0, 0, size.width(), size.height());
    scene.setSceneRect(area);
    QImage image((QSizeF(size) * scale).toSize(), QImage::Format_RGB32);
    image.fill(colour_of(style.background));
    QPainter painter(&image);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    scene.render(&painter, QRectF(QPointF(), QSizeF(image.size())), area);
    return image;
}

}  // namespace ir::widgets
