#include "widgets/image/legend.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "widgets/style/number_text.h"

namespace ir::widgets {
namespace {

QString legend_text(const char* text) {
    return QCoreApplication::translate("Legend", text);
}

struct Mark {
    QColor colour;
    QString text;
    Qt::BrushStyle style = Qt::SolidPattern;
};

/// A number at the bar; at an end that values go beyond, it says so.
struct Tick {
    double value;
    QString text;
};

Tick tick_at(const PreparedPicture& picture, double value) {
    const auto [low, high] = std::minmax(picture.display.low, picture.display.high);
    const QString number = short_number(value);
    if (value == low && picture.occurring->least < low) return {value, QStringLiteral("≤ ") + number};
    if (value == high && picture.occurring->greatest > high) return {value, QStringLiteral("≥ ") + number};
    return {value, number};
}

/// Everything that a legend says, before it is laid out.
struct Contents {
    QStringList lines;
    bool bar = false;
    std::vector<Tick> ticks;
    std::vector<Mark> marks;
};

/// Of what occurs.
std::vector<Mark> marks_of(const PreparedPicture& picture) {
    const Display& display = picture.display;
    const Occurring& occurring = *picture.occurring;
    std::vector<Mark> marks;
    for (const auto& category : occurring.categories)
        marks.push_back({colour_of(category), QString::fromStdString(category.label)});
    if (display.mark_bad) {
        auto bad = occurring.bad;
        if (!display.hide_invalid) bad.add(occurring.hidden_bad);
        if (bad.nan) marks.push_back({{255, 0, 255}, QStringLiteral("NaN")});
        if (bad.plus_infinity) marks.push_back({{255, 255, 0}, QStringLiteral("+Inf")});
        if (bad.minus_infinity) marks.push_back({{0, 255, 255}, QStringLiteral("−Inf")});
        if (bad.negative && display.negative_is_bad)
            marks.push_back({{40, 80, 255}, legend_text("negative")});
    }
    if (display.zebra && display.mode != Display::Mode::ids) {
        marks.push_back({{40, 90, 255}, legend_text("below"), Qt::BDiagPattern});
        marks.push_back({{255, 60, 40}, legend_text("above"), Qt::FDiagPattern});
    }
    if (display.grey_zero)
        marks.push_back({{zero_grey[0], zero_grey[1], zero_grey[2]}, legend_text("within noise")});
    if (display.hide_invalid && occurring.hidden)
        marks.push_back({{136, 136, 136}, legend_text("no value"), Qt::Dense4Pattern});
    return marks;
}

QStringList colour_lines(const Display& display) {
    QStringList lines;
    if (display.exposure != 0) lines << legend_text("exposure %1").arg(exposure_text(display.exposure));
    if (display.tone_map == Display::ToneMap::reinhard) lines << legend_text("tone map Reinhard");
    if (display.tone_map == Display::ToneMap::filmic) lines << legend_text("tone map filmic");
    return lines;
}

Contents contents_of(const PreparedPicture& picture) {
    const Display& display = picture.display;
    Contents contents;
    contents.marks = marks_of(picture);
    const QString unit = picture.picture ? picture.picture->unit : QString();
    const int channels = picture.picture ? picture.picture->image->channels : 1;
    if (!unit.isEmpty()) contents.lines << unit;
    if (!display.categories.empty()) return contents;
    const bool all = channels > 1 && display.channel < 0;
    switch (display.mode) {
        case Display::Mode::colour:
            contents.lines << colour_lines(display);
            return contents;
        case Display::Mode::ids:
            contents.lines << legend_text("a colour for each number");
            return contents;
        case Display::Mode::vector:
            if (all) contents.lines << legend_text("by component");
            break;
        case Display::Mode::scalar:
            if (all) contents.lines << legend_text("largest channel");
            break;
    }
    contents.bar = true;
    for (const double value : legend_ticks(display.low, display.high, 6))
        contents.ticks.push_back(tick_at(picture, value));
    return contents;
}

/// Positions in device pixels; everything scales with the screen.
struct Layout {
    Layout(Contents& contents, const QFont& font, qreal ratio, qreal room) : metrics(font), r(ratio) {
        line = metrics.height() + 2 * r;
        const auto fixed = [&] {
            return 2 * margin() + (contents.lines.size() + contents.marks.size()) * line;
        };
        if (fixed() + (contents.bar ? bar_height + line : 0) > room) contents.marks.clear();
        bar_height = std::clamp(room - fixed() - line, 40 * r, 130 * r);
        for (const auto& text : contents.lines) width = std::max(width, metrics.horizontalAdvance(text));
        for (const auto& tick : contents.ticks)
            width = std::max(width, bar_width() + 8 * r + metrics.horizontalAdvance(tick.text));
        for (const auto& mark : contents.marks)
            width = std::max(width, 18 * r + metrics.horizontalAdvance(mark.text));
        height = fixed() + (contents.bar ? bar_height + line : 0);
        if (contents.bar && bar_height < 90 * r)  // only the ends have room
            contents.ticks = {contents.ticks.front(), contents.ticks.back()};
    }
    qreal bar_width() const { return 16 * r; }
    qreal margin() const { return 8 * r; }
    QSizeF size() const { return {width + 2 * margin(), height}; }

    QFontMetricsF metrics;
    qreal r, bar_height = 130 * r, line = 0, width = 0, height = 0;
};

QFont legend_font(qreal ratio) {
    QFont font = QGuiApplication::font();
    font.setPixelSize(std::max(1, int(11 * ratio)));
    return font;
}

QColor bar_colour(const Display& display, double fraction) {
    if (display.mode == Display::Mode::vector) {
        const int grey = int(fraction * 255 + 0.5);
        return {grey, grey, grey};
    }
    const auto entry = colours_of(display)[std::size_t(fraction * 255 + 0.5)];
    return {entry[0], entry[1], entry[2]};
}

void paint_bar(QPainter& painter, const Display& display, const Contents& contents, const Layout& layout,
               QPointF top_left) {
    const QRectF bar(top_left + QPointF(0, layout.line / 2), QSizeF(layout.bar_width(), layout.bar_height));
    QImage colours(1, 256, QImage::Format_RGB32);
    for (int row = 0; row < 256; ++row)  // the highest value on top
        colours.setPixelColor(0, row, bar_colour(display, 1 - row / 255.0));
    painter.drawImage(bar, colours);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(235, 235, 235), layout.r));
    painter.drawRect(bar);
    const double width = display.high - display.low;
    for (const auto& tick : contents.ticks) {
        const double fraction = width == 0 ? 0 : (tick.value - display.low) / width;
        const qreal y = bar.bottom() - fraction * bar.height();
        painter.drawLine(QPointF(bar.right(), y), QPointF(bar.right() + 4 * layout.r, y));
        painter.drawText(QRectF(bar.right() + 8 * layout.r, y - layout.line / 2, layout.width, layout.line),
                         Qt::AlignLeft | Qt::AlignVCenter, tick.text);
    }
}

/// Stripes lean like the zebra's; a chequer is of four fields.
void paint_swatch(QPainter& painter, const Mark& mark, const QRectF& box, qreal ratio) {
    painter.save();
    painter.setClipRect(box);
    painter.fillRect(box, mark.style == Qt::SolidPattern ? mark.colour : QColor(160, 160, 160));
    const qreal side = box.width();
    const bool rising = mark.style == Qt::BDiagPattern;
    if (rising || mark.style == Qt::FDiagPattern) {
        painter.setPen(QPen(mark.colour, 2.5 * ratio));
        for (qreal x = -side; x < side * 2; x += 5.5 * ratio)
            painter.drawLine(QPointF(box.left() + x, rising ? box.bottom() : box.top()),
                             QPointF(box.left() + x + side, rising ? box.top() : box.bottom()));
    } else if (mark.style != Qt::SolidPattern) {
        const QSizeF half = box.size() / 2;
        painter.fillRect(QRectF(box.topLeft(), half), QColor(100, 100, 100));
        painter.fillRect(QRectF(box.center(), half), QColor(100, 100, 100));
    }
    painter.restore();
}

void paint_mark(QPainter& painter, const Mark& mark, const Layout& layout, QPointF top_left) {
    const qreal side = 11 * layout.r;
    const QRectF box(top_left + QPointF(0, (layout.line - side) / 2), QSizeF(side, side));
    paint_swatch(painter, mark, box, layout.r);
    painter.setPen(QColor(235, 235, 235));
    painter.drawText(QRectF(top_left + QPointF(18 * layout.r, 0), QSizeF(layout.width, layout.line)),
                     Qt::AlignLeft | Qt::AlignVCenter, mark.text);
}

/// A row that is filled from the left, as long as there is room.
class Line {
  public:
    Line(QPainter& painter, const QRectF& row, qreal ratio) : painter_(painter), row_(row), r_(ratio) {}

    void text(const QString& words) {
        if (words.isEmpty()) return;
        gap();
        const QFontMetricsF metrics(painter_.font());
        const QString fitting = metrics.elidedText(words, Qt::ElideRight, row_.width());
        painter_.drawText(row_, Qt::AlignLeft | Qt::AlignVCenter, fitting);
        advance(metrics.horizontalAdvance(fitting));
    }
    void bar(const Display& display, const QString& low, const QString& high) {
        text(low);
        if (row_.width() < 40 * r_) return;
        const QRectF box(row_.left() + 6 * r_, row_.center().y() - 4 * r_,
                         std::min(110 * r_, row_.width() / 3), 8 * r_);
        QImage colours(256, 1, QImage::Format_RGB32);
        for (int x = 0; x < 256; ++x) colours.setPixelColor(x, 0, bar_colour(display, x / 255.0));
        painter_.drawImage(box, colours);
        advance(box.width() + 12 * r_);
        begun_ = false;  // the number belongs to the bar
        text(high);
    }
    void mark(const Mark& mark) {
        gap();
        if (row_.width() < 40 * r_) return;
        paint_swatch(painter_, mark, QRectF(row_.left(), row_.center().y() - 5 * r_, 10 * r_, 10 * r_), r_);
        painter_.setPen(QColor(235, 235, 235));
        advance(15 * r_);
        begun_ = false;
        text(mark.text);
    }

  private:
    void gap() {
        if (begun_) advance(12 * r_);
        begun_ = true;
    }
    void advance(qreal width) { row_.setLeft(std::min(row_.left() + width, row_.right())); }
    QPainter& painter_;
    QRectF row_;
    qreal r_;
    bool begun_ = false;
};

}  // namespace

std::vector<double> legend_ticks(double low, double high, int count) {
    if (low == high || !std::isfinite(low) || !std::isfinite(high)) return {low};
    const double lowest = std::min(low, high), highest = std::max(low, high), width = highest - lowest;
    const double raw = width / std::max(1, count - 1), power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (double factor : {1.0, 2.0, 5.0})
        if (factor * power >= raw * (1 - 1e-9)) {
            step = factor * power;
            break;
        }
    std::vector<double> ticks = {lowest};
    for (double k = std::ceil(lowest / step); k * step < highest; ++k) {
        const double tick = k * step;
        // An end's number must stay readable.
        if (tick - lowest > width * 0.1 && highest - tick > width * 0.1) ticks.push_back(tick);
    }
    ticks.push_back(highest);
    return ticks;
}

qreal legend_line_height(qreal pixel_ratio) {
    return QFontMetricsF(legend_font(pixel_ratio)).height() + 6 * pixel_ratio;
}

void paint_legend_line(QPainter& painter, const PreparedPicture& picture, const QRectF& row,
                       qreal pixel_ratio) {
    if (picture.empty()) return;
    const Contents contents = contents_of(picture);
    painter.save();
    painter.fillRect(row, QColor(20, 20, 20, 200));
    painter.setFont(legend_font(pixel_ratio));
    painter.setPen(QColor(235, 235, 235));
    Line line(painter, row.adjusted(8 * pixel_ratio, 0, -8 * pixel_ratio, 0), pixel_ratio);
    for (const auto& text : contents.lines) line.text(text);
    if (contents.bar)
        line.bar(picture.display, tick_at(picture, picture.display.low).text,
                 tick_at(picture, picture.display.high).text);
    for (const auto& mark : contents.marks) line.mark(mark);
    painter.restore();
}

bool has_legend(const PreparedPicture& picture) {
    if (picture.empty()) return false;
    const Contents contents = contents_of(picture);
    return contents.bar || !contents.lines.isEmpty() || !contents.marks.empty();
}

QSizeF legend_size(const PreparedPicture& picture, qreal pixel_ratio, qreal room) {
    if (picture.empty()) return {};
    Contents contents = contents_of(picture);
    return Layout(contents, legend_font(pixel_ratio), pixel_ratio, room).size();
}

void paint_legend(QPainter& painter, const PreparedPicture& picture, QPointF top_left, qreal pixel_ratio,
                  qreal room) {
    if (picture.empty()) return;
    Contents contents = contents_of(picture);
    const QFont font = legend_font(pixel_ratio);
    const Layout layout(contents, font, pixel_ratio, room);
    painter.save();
    painter.setFont(font);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 200));
    painter.drawRoundedRect(QRectF(top_left, layout.size()), 4 * pixel_ratio, 4 * pixel_ratio);
    QPointF at = top_left + QPointF(layout.margin(), layout.margin());
    painter.setPen(QColor(235, 235, 235));
    for (const auto& text : contents.lines) {
        painter.drawText(QRectF(at, QSizeF(layout.width + layout.margin(), layout.line)),
                         Qt::AlignLeft | Qt::AlignVCenter, text);
        at.ry() += layout.line;
    }
    if (contents.bar) {
        paint_bar(painter, picture.display, contents, layout, at);
        at.ry() += layout.bar_height + layout.line;
    }
    for (const auto& mark : contents.marks) {
        paint_mark(painter, mark, layout, at);
        at.ry() += layout.line;
    }
    painter.restore();
}

}  // namespace ir::widgets
