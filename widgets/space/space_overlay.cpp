#include "widgets/space/space_overlay.h"

#include <QPainterPath>
#include <algorithm>
#include <array>
#include <cmath>

#include "renderers/image/colour_map.h"
#include "widgets/image/display.h"
#include "widgets/space/space_camera.h"

namespace ir::widgets {
namespace {

constexpr QColor badge_colour{20, 20, 20, 200}, text_colour{235, 235, 235}, dim_text_colour{175, 175, 175};
constexpr double gap = 10, padding = 8;

QFont small_font(const QPainter& painter, int pixels = 12, bool bold = false) {
    QFont font = painter.font();
    font.setPixelSize(pixels);
    font.setBold(bold);
    return font;
}

void paint_box(QPainter& painter, const QRectF& box) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(badge_colour);
    painter.drawRoundedRect(box, 4, 4);
}

/// Lines of text in a badge whose corner nearest to the area's own lies at `corner`.
QRectF paint_lines(QPainter& painter, const QStringList& lines, QPointF top_left, double most_width) {
    painter.setFont(small_font(painter));
    const QFontMetricsF metrics(painter.font());
    double width = 0;
    for (const QString& line : lines) width = std::max(width, metrics.horizontalAdvance(line));
    width = std::min(width, most_width - 2 * padding);
    const QRectF box(top_left, QSizeF(width + 2 * padding, lines.size() * metrics.lineSpacing() + padding));
    paint_box(painter, box);
    double y = box.top() + padding / 2;
    for (const QString& line : lines) {
        painter.setPen(text_colour);
        painter.drawText(QRectF(box.left() + padding, y, width, metrics.lineSpacing()), Qt::AlignVCenter,
                         metrics.elidedText(line, Qt::ElideRight, width));
        y += metrics.lineSpacing();
    }
    return box;
}

struct Axis {
    glm::dvec3 direction;
    QColor colour;
    QString name;
};

void paint_tripod(QPainter& painter, const CameraPose& pose, QPointF middle) {
    constexpr double reach = 24;
    const CameraAxes axes = camera_axes(pose);
    std::array<Axis, 3> three{Axis{{1, 0, 0}, QColor(235, 95, 90), QStringLiteral("X")},
                              Axis{{0, 1, 0}, QColor(120, 205, 105), QStringLiteral("Y")},
                              Axis{{0, 0, 1}, QColor(105, 160, 250), QStringLiteral("Z")}};
    // Those that point away first, so that the near ones lie over them.
    std::sort(three.begin(), three.end(), [&](const Axis& a, const Axis& b) {
        return glm::dot(a.direction, axes.forward) > glm::dot(b.direction, axes.forward);
    });
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 120));
    painter.drawEllipse(middle, reach + 12, reach + 12);
    painter.setFont(small_font(painter, 11, true));
    for (const Axis& axis : three) {
        const QPointF tip(glm::dot(axis.direction, axes.right) * reach,
                          -glm::dot(axis.direction, axes.up) * reach);
        painter.setPen(QPen(axis.colour, 2, Qt::SolidLine, Qt::RoundCap));
        painter.drawLine(middle, middle + tip);
        const QPointF letter = middle + tip * 1.3;
        painter.drawText(QRectF(letter - QPointF(8, 8), QSizeF(16, 16)), Qt::AlignCenter, axis.name);
    }
}

QString length_text(double metres) {
    if (metres >= 1000) return short_number(metres / 1000) + QStringLiteral(" km");
    if (metres >= 1) return short_number(metres) + QStringLiteral(" m");
    if (metres >= 0.01) return short_number(metres * 100) + QStringLiteral(" cm");
    return short_number(metres * 1000) + QStringLiteral(" mm");
}

/// A ruler that is exact at the camera's target.
void paint_scale(QPainter& painter, const CameraPose& pose, const QRectF& area) {
    const double per_pixel = height_at_target(pose) / std::max(1.0, area.height());
    const double metres = round_length(std::min(110.0, area.width() / 4) * per_pixel);
    if (metres <= 0) return;
    const double length = metres / per_pixel;
    const QString text =
        pose.orthographic ? length_text(metres) : QStringLiteral("%1 at the target").arg(length_text(metres));
    painter.setFont(small_font(painter, 11));
    const double width = std::max(length, QFontMetricsF(painter.font()).horizontalAdvance(text));
    const QRectF box(area.right() - gap - width - 2 * padding, area.bottom() - gap - 30, width + 2 * padding,
                     30);
    paint_box(painter, box);
    painter.setPen(text_colour);
    painter.drawText(box.adjusted(0, 1, 0, -9), Qt::AlignCenter, text);
    const double left = box.center().x() - length / 2, y = box.bottom() - 6;
    painter.setPen(QPen(text_colour, 1.5));
    painter.drawPolyline(QPolygonF{QPointF(left, y - 4), QPointF(left, y), QPointF(left + length, y),
                                   QPointF(left + length, y - 4)});
}

void paint_colour_bar(QPainter& painter, const QRectF& bar, const std::string& name) {
    const ColourMap& map = colour_map(name);
    QImage strip(int(map.size()), 1, QImage::Format_RGB32);
    for (int i = 0; i < strip.width(); ++i)
        strip.setPixelColor(i, 0,
                            QColor(map[std::size_t(i)][0], map[std::size_t(i)][1], map[std::size_t(i)][2]));
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(bar, strip);
    painter.setPen(QPen(QColor(0, 0, 0, 120), 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(bar);
}

struct Legend {
    const SpaceLayer* layer;
    const LayerInfo* info;
    bool is_ramp() const {
        return !layer->colour_by.empty() && layer->colour_by != SpaceLayer::facing && info->note.empty();
    }
};

/// One layer: its label, what its colours mean, how many of its elements are drawn. Returns the bottom.
double paint_legend(QPainter& painter, const Legend& legend, const QRectF& area, double top) {
    const double width = std::min(230.0, area.width() - 2 * gap);
    const double height = legend.is_ramp() ? 74 : 40;
    const QRectF box(area.right() - gap - width, top, width, height);
    paint_box(painter, box);
    const QRectF inner = box.adjusted(padding, 4, -padding, -4);
    const auto line = [&](double y, const QString& text, const QColor& colour, Qt::Alignment where) {
        painter.setPen(colour);
        painter.drawText(QRectF(inner.left(), inner.top() + y, inner.width(), 16), where | Qt::AlignVCenter,
                         QFontMetricsF(painter.font()).elidedText(text, Qt::ElideRight, inner.width()));
    };
    painter.setFont(small_font(painter, 12, true));
    const QString label = QString::fromStdString(legend.layer->label);
    const QString meaning = colour_text(*legend.layer, legend.info->fields);
    line(0, legend.layer->colour_by.empty() ? label : label + QStringLiteral(" · ") + meaning, text_colour,
         Qt::AlignLeft);
    painter.setFont(small_font(painter, 11));
    double y = 17;
    if (legend.is_ramp()) {
        paint_colour_bar(painter, QRectF(inner.left(), inner.top() + y + 2, inner.width(), 10),
                         legend.layer->colour_map);
        line(y + 14, short_number(legend.info->low), text_colour, Qt::AlignLeft);
        line(y + 14, short_number(legend.info->high), text_colour, Qt::AlignRight);
        y += 32;
    }
    const QString last = legend.info->note.empty()
                             ? amount_text(legend.layer->kind, legend.info->elements, legend.info->stride)
                             : QString::fromStdString(legend.info->note);
    line(y, last, legend.info->note.empty() ? dim_text_colour : QColor(232, 179, 74), Qt::AlignLeft);
    return box.bottom();
}

void paint_legends(QPainter& painter, const OverlayState& state, const QRectF& area) {
    double top = area.top() + gap;
    for (std::size_t i = 0; i < state.infos.size() && i < state.indices.size(); ++i) {
        if (state.indices[i] < 0 || top > area.bottom() - 140) continue;
        const Legend legend{&state.scene.layers[std::size_t(state.indices[i])], &state.infos[i]};
        top = paint_legend(painter, legend, area, top) + 6;
    }
}

void paint_hover(QPainter& painter, const OverlayState& state, const QRectF& area) {
    if (state.hover.isEmpty()) return;
    const QStringList lines = state.hover.split(QLatin1Char('\n'));
    painter.setFont(small_font(painter));
    const QFontMetricsF metrics(painter.font());
    double width = 2 * padding;
    for (const QString& line : lines) width = std::max(width, metrics.horizontalAdvance(line) + 2 * padding);
    const double height = lines.size() * metrics.lineSpacing() + padding;
    QPointF at = state.hover_at + QPointF(16, 14);
    // Beside the cursor, on the side where there is room.
    if (at.x() + width > area.right()) at.setX(std::max(area.left(), state.hover_at.x() - 12 - width));
    if (at.y() + height > area.bottom()) at.setY(std::max(area.top(), state.hover_at.y() - 10 - height));
    paint_lines(painter, lines, at, area.width());
}

class Overlay final : public QWidget {
  public:
    Overlay(const OverlayState& state, QWidget* parent) : QWidget(parent), state_(state) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setAttribute(Qt::WA_NoSystemBackground);
    }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        paint_space_overlay(painter, state_, rect());
    }

  private:
    const OverlayState& state_;
};

}  // namespace

void paint_space_overlay(QPainter& painter, const OverlayState& state, const QRectF& area) {
    painter.setRenderHint(QPainter::Antialiasing);
    if (state.has_picture) {
        paint_tripod(painter, state.camera, area.bottomLeft() + QPointF(46, -46));
        if (!shows_sphere(state.scene)) paint_scale(painter, state.camera, area);
        paint_legends(painter, state, area);
    }
    if (!state.note.isEmpty() && state.has_picture)
        paint_lines(painter, {state.note}, area.topLeft() + QPointF(gap, gap), area.width() - 2 * gap);
    paint_hover(painter, state, area);
}

QWidget* make_space_overlay(const OverlayState& state, QWidget* parent) {
    return new Overlay(state, parent);
}

}  // namespace ir::widgets
