#pragma once

#include <QColor>
#include <QFont>
#include <QImage>

#include "renderers/plot/plot_drawing.h"

class QPainter;

namespace ir::widgets {

inline QColor colour_of(const PlotColour& colour) {
    return QColor(QLatin1String(colour.c_str()));
}

/// That goes with the window's theme.
const PlotStyle& window_style();

/// Draws plots with a painter, or measures their texts without one.
class PlotPainter : public PlotCanvas {
  public:
    explicit PlotPainter(const QFont& font, QPainter* painter = nullptr);
    double line_height() const override;
    double width_of(const std::string& words, Letters letters) const override;
    void text(Place at, const std::string& words, Anchor anchor, const Ink& ink, Letters letters) override;
    void line(const std::vector<Place>& places, const Ink& ink, const Stroke& stroke) override;
    void shape(const Shape& shape) override;
    void box(const Box& box, const Ink& ink) override;

  private:
    QFont font_, title_font_;
    QPainter* painter_;
};

/// The plot with title, axes and legend, size · scale pixels large.
QImage plot_picture(const PlotData& data, const QSize& size, double scale, const PlotStyle& style);

}  // namespace ir::widgets
