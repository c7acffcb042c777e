#include <algorithm>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "widgets/image/display.h"
#include "widgets/space/overlay_parts.h"

namespace ir::widgets::overlay {
namespace {

constexpr double line_height = 16, row_height = line_height + 4, bar_height = 10, max_width = 230;

/// In smaller views, logical pixels, legends are lines.
constexpr double legend_width = 640, legend_height = 420;

void paint_map(QPainter& painter, const QRectF& bar, const std::string& name) {
    const auto& known = colour_map_names();
    const bool is_known = std::find(known.begin(), known.end(), name) != known.end();
    const ColourMap& map = colour_map(is_known ? name : "viridis");
    QImage strip(int(map.size()), 1, QImage::Format_RGB32);
    for (int i = 0; i < strip.width(); ++i) {
        const auto& c = map[std::size_t(i)];
        strip.setPixelColor(i, 0, QColor(c[0], c[1], c[2]));
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(bar, strip);
    painter.setPen(QPen(QColor(0, 0, 0, 120), 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(bar);
}

/// One layer's legend, painted or only measured.
class Legend {
  public:
    Legend(QPainter& painter, const LayerInfo& info, const QRectF& box)
        : painter_(painter),
          layer_(info.requested),
          info_(info),
          inner_(box.adjusted(padding, 4, -padding, -4)) {}

    double height() { return walk(false) + 8; }
    void paint() { walk(true); }

  private:
    double walk(bool paint) {
        painting_ = paint;
        y_ = 0;
        const QString label = QString::fromStdString(layer_.label);
        painter_.setFont(small_font(painter_, 12, true));
        const QString field =
            layer_.colour_by.empty() ? QString() : QStringLiteral(" · ") + colour_text(layer_, info_.fields);
        line(label_beside(label, field) + field, text_colour);
        painter_.setFont(small_font(painter_, 11));
        if (!info_.categories.empty())
            swatches();
        else if (!layer_.colour_by.empty() && info_.elements > 0)
            ramp();
        if (info_.elements > 0) line(amount_text(info_), dim_text_colour);
        if (!info_.note.empty()) paragraph(QString::fromStdString(info_.note));
        return y_;
    }
    /// Of a long name its end gives way, not the field, which stands nowhere else in the view.
    QString label_beside(const QString& label, const QString& field) const {
        const QFontMetricsF metrics(painter_.font());
        const double room = inner_.width() - metrics.horizontalAdvance(field);
        return metrics.elidedText(label, Qt::ElideRight, std::max(room, inner_.width() / 3));
    }
    void line(const QString& text, const QColor& colour) {
        if (painting_) write(text, colour, Qt::AlignLeft);
        y_ += line_height;
    }
    void write(const QString& text, const QColor& colour, Qt::Alignment where) {
        painter_.setPen(colour);
        painter_.drawText(QRectF(inner_.left(), inner_.top() + y_, inner_.width(), line_height),
                          where | Qt::AlignVCenter,
                          QFontMetricsF(painter_.font()).elidedText(text, Qt::ElideRight, inner_.width()));
    }
    void paragraph(const QString& text) {
        const QRectF room(inner_.left(), inner_.top() + y_ + 1, inner_.width(), 6 * line_height);
        const QRectF taken = painter_.boundingRect(room, Qt::TextWordWrap, text);
        painter_.setPen(warning_colour);
        if (painting_) painter_.drawText(room, Qt::TextWordWrap, text);
        y_ += std::min(taken.height(), room.height()) + 1;
    }
    /// Of the names that occur.
    void swatches() {
        for (const auto& category : info_.categories) {
            const QRectF row(inner_.left(), inner_.top() + y_, inner_.width(), line_height);
            if (painting_) {
                painter_.fillRect(QRectF(row.left(), row.top() + 3, 11, 11), colour_of(category));
                painter_.setPen(text_colour);
                const QRectF room = row.adjusted(17, 0, 0, 0);
                painter_.drawText(
                    room, Qt::AlignLeft | Qt::AlignVCenter,
                    QFontMetricsF(painter_.font())
                        .elidedText(QString::fromStdString(category.label), Qt::ElideRight, room.width()));
            }
            y_ += line_height;
        }
    }
    void ramp() {
        const QRectF bar(inner_.left(), inner_.top() + y_ + 3, inner_.width(), bar_height);
        if (painting_) paint_map(painter_, bar, layer_.colour_map);
        y_ += bar_height + 4;
        if (painting_) {
            const bool is_field = std::any_of(info_.fields.begin(), info_.fields.end(),
                                              [&](const Field& f) { return f.name == layer_.colour_by; });
            const bool facing = layer_.colour_by == SpaceLayer::facing && !is_field;
            write(facing ? QStringLiteral("turned away") : short_number(info_.low), text_colour,
                  Qt::AlignLeft);
            write(facing ? QStringLiteral("towards you") : short_number(info_.high), text_colour,
                  Qt::AlignRight);
        }
        y_ += line_height;
    }
    QPainter& painter_;
    const SpaceLayer& layer_;
    const LayerInfo& info_;
    QRectF inner_;
    double y_ = 0;
    bool painting_ = false;
};

/// In one line: label, colours and their meaning. Returns its height.
double paint_line(QPainter& painter, const LayerInfo& info, const QRectF& row) {
    painter.fillRect(row, badge_colour);
    painter.setFont(small_font(painter, 11));
    const QFontMetricsF metrics(painter.font());
    double x = row.left() + padding;
    const auto write = [&](const QString& text, const QColor& colour) {
        const QString fitting = metrics.elidedText(text, Qt::ElideRight, row.right() - padding - x);
        painter.setPen(colour);
        painter.drawText(QRectF(x, row.top(), row.right() - x, row.height()),
                         Qt::AlignLeft | Qt::AlignVCenter, fitting);
        x += metrics.horizontalAdvance(fitting) + padding;
    };
    write(info.requested.colour_by.empty() ? QString::fromStdString(info.requested.label)
                                           : colour_text(info.requested, info.fields),
          text_colour);
    for (const auto& category : info.categories) {
        if (x > row.right() - 30) break;
        painter.fillRect(QRectF(x, row.center().y() - 5, 10, 10), colour_of(category));
        x += 14;
        write(QString::fromStdString(category.label), text_colour);
    }
    if (info.categories.empty() && !info.requested.colour_by.empty() && info.elements > 0 &&
        info.requested.colour_by != SpaceLayer::facing) {
        write(short_number(info.low), dim_text_colour);
        const QRectF bar(x - 2, row.center().y() - 4, std::min(80.0, std::max(0.0, row.right() - x - 60)), 8);
        paint_map(painter, bar, info.requested.colour_map);
        x = bar.right() + 6;
        write(short_number(info.high), dim_text_colour);
    }
    write(info.note.empty() ? amount_text(info) : QString::fromStdString(info.note),
          info.note.empty() ? dim_text_colour : warning_colour);
    return row.height();
}

}  // namespace

double paint_legends(QPainter& painter, const OverlayState& state, const QRectF& area) {
    if (const double strip = legend_strip(state.layers.size(), area.size()); strip > 0) {
        double high = 0;
        for (auto info = state.layers.begin(); high < strip; ++info)
            high += paint_line(painter, *info, {area.left(), area.top() + high, area.width(), row_height});
        return strip;
    }
    const double width = std::min(max_width, area.width() - 2 * gap);
    double top = area.top() + gap;
    for (const LayerInfo& info : state.layers) {
        QRectF box(area.right() - gap - width, top, width, 0);
        Legend legend(painter, info, box);
        box.setHeight(legend.height());
        if (box.bottom() > area.bottom() - 60) break;  // the scale stands there
        paint_box(painter, box);
        legend.paint();
        top = box.bottom() + 6;
    }
    return 0;
}

}  // namespace ir::widgets::overlay

namespace ir::widgets {

double legend_strip(std::size_t layers, const QSizeF& area) {
    using namespace overlay;
    if (area.width() >= legend_width && area.height() >= legend_height) return 0;
    const double most = std::floor(area.height() / 4 / row_height) + 1;
    return row_height * std::min(double(layers), most);
}

}  // namespace ir::widgets
