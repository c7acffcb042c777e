#include "widgets/space/space_overlay.h"

#include <QPainterPath>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/image/display.h"
#include "widgets/space/overlay_parts.h"
#include "widgets/space/space_camera.h"

namespace ir::widgets {
namespace {

using namespace overlay;

/// Lines of text in a badge whose corner nearest to the area's own lies at `corner`.
QRectF paint_lines(QPainter& painter, const QStringList& lines, QPointF top_left, double max_width) {
    painter.setFont(small_font(painter));
    const QFontMetricsF metrics(painter.font());
    double width = 0;
    for (const QString& line : lines) width = std::max(width, metrics.horizontalAdvance(line));
    width = std::min(width, max_width - 2 * padding);
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

struct TripodAxis {
    glm::dvec3 direction;
    QColor colour;
    QString name;
};

void paint_tripod(QPainter& painter, const CameraPose& pose, QPointF middle) {
    constexpr double reach = 24;
    const CameraAxes axes = camera_axes(pose);
    std::array<TripodAxis, 3> three{TripodAxis{{1, 0, 0}, QColor(235, 95, 90), QStringLiteral("X")},
                                    TripodAxis{{0, 1, 0}, QColor(120, 205, 105), QStringLiteral("Y")},
                                    TripodAxis{{0, 0, 1}, QColor(105, 160, 250), QStringLiteral("Z")}};
    // Those that point away first, so that the near ones lie over them.
    std::sort(three.begin(), three.end(), [&](const TripodAxis& a, const TripodAxis& b) {
        return glm::dot(a.direction, axes.forward) > glm::dot(b.direction, axes.forward);
    });
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(20, 20, 20, 120));
    painter.drawEllipse(middle, reach + 12, reach + 12);
    painter.setFont(small_font(painter, 11, true));
    for (const TripodAxis& axis : three) {
        const QPointF tip(glm::dot(axis.direction, axes.right) * reach,
                          -glm::dot(axis.direction, axes.up) * reach);
        // Darker where it points away: seen end-on, both ways would look alike.
        const bool away = glm::dot(axis.direction, axes.forward) > 0;
        painter.setPen(QPen(away ? axis.colour.darker(160) : axis.colour, away ? 1.5 : 2.5, Qt::SolidLine,
                            Qt::RoundCap));
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

/// Neither the unit sphere of directions nor a space of its own has metres.
bool has_metres(const OverlayState& state) {
    return state.layers.empty() ||
           std::any_of(state.layers.begin(), state.layers.end(), [](const LayerInfo& info) {
               return space_of(info.requested.kind, info.fields) == Space::scene;
           });
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
    double lines = 0;
    if (state.has_picture) {
        paint_tripod(painter, state.camera, area.bottomLeft() + QPointF(46, -46));
        if (has_metres(state)) {
            paint_marks(painter, state.marks, state.camera, area);
            paint_scale(painter, state.camera, area);
        }
        lines = paint_legends(painter, state, area);
    }
    const QString badge = !state.note.isEmpty() ? state.note
                          : state.stale         ? QStringLiteral("rendering …")
                          : state.busy          ? QStringLiteral("drawing …")
                                                : QString();
    QStringList said{state.moment, badge};
    said.removeAll(QString());
    if (!said.isEmpty() && state.has_picture)
        paint_lines(painter, said, area.topLeft() + QPointF(gap, gap + lines), area.width() - 2 * gap);
    paint_hover(painter, state, area);
}

QWidget* make_space_overlay(const OverlayState& state, QWidget* parent) {
    return new Overlay(state, parent);
}

namespace overlay {

QFont small_font(const QPainter& painter, int pixels, bool bold) {
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

}  // namespace overlay

}  // namespace ir::widgets
