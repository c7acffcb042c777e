#include "widgets/plot/plot_painter.h"

#include <QApplication>
#include <QFontMetricsF>
#include <QPainter>
#include <QPolygonF>

#include "widgets/style/theme.h"

namespace ir::widgets {

const PlotStyle& window_style() {
    return theme() == Theme::dark ? PlotStyle::screen() : PlotStyle::paper();
}

PlotPainter::PlotPainter(const QFont& font, QPainter* painter)
    : font_(font), title_font_(font), painter_(painter) {
    title_font_.setBold(true);
    if (painter_) painter_->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
}

double PlotPainter::line_height() const {
    return QFontMetricsF(font_).height() + 4;
}

double PlotPainter::width_of(const std::string& words, Letters letters) const {
    const auto& font = letters == Letters::title ? title_font_ : font_;
    return QFontMetricsF(font).horizontalAdvance(QString::fromStdString(words));
}

void PlotPainter::text(Place at, const std::string& words, Anchor anchor, const Ink& ink, Letters letters) {
    const auto& font = letters == Letters::title ? title_font_ : font_;
    const QFontMetricsF metrics(font);
    const double share = anchor == Anchor::start ? 0 : anchor == Anchor::middle ? 0.5 : 1;
    painter_->save();
    painter_->translate(at.x, at.y);
    if (letters == Letters::upwards) painter_->rotate(-90);
    painter_->setFont(font);
    painter_->setPen(colour_of(ink.colour));
    painter_->drawText(QPointF(-share * width_of(words, letters), (metrics.ascent() - metrics.descent()) / 2),
                       QString::fromStdString(words));
    painter_->restore();
}

void PlotPainter::line(const std::vector<Place>& places, const Ink& ink, const Stroke& stroke) {
    QPolygonF points;
    for (const auto& [x, y] : places) points << QPointF(x, y);
    QColor colour = colour_of(ink.colour);
    colour.setAlphaF(float(stroke.opacity));
    QPen pen(colour, stroke.width);
    QList<qreal> dashes;  // a pen counts them in its widths
    for (const double length : stroke.dashes) dashes << length / stroke.width;
    if (!dashes.isEmpty()) pen.setDashPattern(dashes);
    painter_->setPen(pen);
    painter_->drawPolyline(points);
}

void PlotPainter::shape(const Shape& shape) {
    painter_->setPen(QPen(colour_of(shape.outline), shape.outline_width));
    painter_->setBrush(shape.fill.empty() ? QBrush(Qt::NoBrush) : QBrush(colour_of(shape.fill)));
    const QPointF centre(shape.centre.x, shape.centre.y);
    QPolygonF outline;
    for (const auto& [x, y] : shape.corners) outline << centre + QPointF(x, y) * shape.radius;
    if (outline.isEmpty()) return painter_->drawEllipse(centre, shape.radius, shape.radius);
    painter_->drawPolygon(outline);
}

void PlotPainter::box(const Box& box, const Ink& ink) {
    painter_->fillRect(QRectF(box.left, box.top, box.width(), box.height()), colour_of(ink.colour));
}

QImage plot_picture(const PlotData& data, const QSize& size, double scale, const PlotStyle& style) {
    QImage image((QSizeF(size) * scale).toSize(), QImage::Format_RGB32);
    image.fill(colour_of(style.background));
    QPainter painter(&image);
    painter.scale(scale, scale);
    PlotPainter canvas(QApplication::font(), &painter);
    PlotDrawing(data, style, size.width(), size.height(), true, canvas).draw(canvas);
    return image;
}

}  // namespace ir::widgets
