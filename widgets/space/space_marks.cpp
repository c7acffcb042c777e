#include "widgets/space/space_marks.h"

#include <QPainter>
#include <array>
#include <optional>

#include "widgets/space/overlay_parts.h"

namespace ir::widgets {
namespace {

constexpr double pin_radius = 4;
/// Beyond that many times the picture's sides lines are left out: painters count in few digits.
constexpr double far_out = 20;

std::optional<QPointF> seen_at(const CameraPose& camera, const QRectF& area, const glm::dvec3& point) {
    const auto place = place_of(camera, area.width() / std::max(1.0, area.height()), point);
    if (!place || !(glm::abs(place->x) < far_out && glm::abs(place->y) < far_out)) return {};
    return QPointF(area.left() + place->x * area.width(), area.top() + place->y * area.height());
}

}  // namespace

std::vector<SpaceMarks::Line> frustum(const CameraPose& pose, double aspect, double distance,
                                      const QColor& colour, double width) {
    const auto axes = camera_axes(pose);
    const auto corner = [&](double x, double y) {
        const auto sight = sight_through(pose, aspect, {x, y});
        return sight.origin + sight.direction * (distance / glm::dot(sight.direction, axes.forward));
    };
    const std::array corners{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    std::vector<SpaceMarks::Line> lines{
        {{corners[0], corners[1], corners[2], corners[3], corners[0]}, colour, width}};
    for (const auto& each : corners) lines.push_back({{pose.eye, each}, colour, width});
    const auto side = corners[1] - corners[0], up = (corners[0] - corners[3]) * 0.25;
    lines.push_back(
        {{corners[0] + 0.35 * side, corners[0] + 0.5 * side + up, corners[0] + 0.65 * side}, colour, width});
    return lines;
}

void paint_marks(QPainter& painter, const SpaceMarks& marks, const CameraPose& camera, const QRectF& area) {
    painter.save();
    painter.setClipRect(area);
    painter.setBrush(Qt::NoBrush);
    for (const auto& line : marks.lines) {
        painter.setPen(QPen(line.colour, line.width, Qt::SolidLine, Qt::RoundCap));
        std::optional<QPointF> before;
        for (const auto& point : line.points) {
            const auto at = seen_at(camera, area, point);
            if (before && at) painter.drawLine(*before, *at);
            before = at;
        }
    }
    painter.setFont(overlay::small_font(painter, 11, true));
    for (const auto& pin : marks.pins) {
        const auto at = seen_at(camera, area, pin.place);
        if (!at) continue;
        painter.setPen(QPen(overlay::badge_colour, 1.5));
        painter.setBrush(pin.colour);
        painter.drawEllipse(*at, pin_radius, pin_radius);
        const QString text = QString::number(pin.number);
        const double wide = painter.fontMetrics().horizontalAdvance(text) + 8;
        const QRectF box(*at + QPointF(pin_radius + 2, -8), QSizeF(wide, 16));
        overlay::paint_box(painter, box);
        painter.setPen(pin.colour);
        painter.drawText(box, Qt::AlignCenter, text);
    }
    painter.restore();
}

}  // namespace ir::widgets
