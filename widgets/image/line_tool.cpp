#include "widgets/image/line_tool.h"
#include "renderers/core/constants.h"

#include <QKeyEvent>
#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

/// Logical pixels within which an end, or the line between them, is taken hold of.
constexpr double end_reach = 9, line_reach = 6;

QPoint inside(QPoint pixel, QSize picture) {
    return {std::clamp(pixel.x(), 0, picture.width() - 1), std::clamp(pixel.y(), 0, picture.height() - 1)};
}

QPoint pixel_of(QPointF at, QSize picture) {
    return inside({int(std::floor(at.x())), int(std::floor(at.y()))}, picture);
}

double distance_to_segment(QPointF at, QPointF from, QPointF to) {
    const QPointF along = to - from, away = at - from;
    const double length = QPointF::dotProduct(along, along);
    const double part = length > 0 ? std::clamp(QPointF::dotProduct(away, along) / length, 0.0, 1.0) : 0;
    const QPointF apart = away - part * along;
    return std::hypot(apart.x(), apart.y());
}

/// The nearest of the eight directions; a diagonal ends where the picture does.
QPoint straightened(QPoint from, QPoint to, QSize picture) {
    const int x = std::abs(to.x() - from.x()), y = std::abs(to.y() - from.y());
    const double half_way = std::tan(double(ir::pi) / 8);
    if (y < half_way * x) return {to.x(), from.y()};
    if (x < half_way * y) return {from.x(), to.y()};
    const QPoint sign(to.x() < from.x() ? -1 : 1, to.y() < from.y() ? -1 : 1);
    const int length = std::min({std::max(x, y), sign.x() < 0 ? from.x() : picture.width() - 1 - from.x(),
                                 sign.y() < 0 ? from.y() : picture.height() - 1 - from.y()});
    return from + length * sign;
}

/// Moved as it is, as far as the picture goes.
QLine moved(const QLine& line, QPoint by, QSize picture) {
    const QRect box = QRect(line.p1(), QSize(1, 1)) | QRect(line.p2(), QSize(1, 1));
    return line.translated(std::clamp(by.x(), -box.left(), picture.width() - 1 - box.right()),
                           std::clamp(by.y(), -box.top(), picture.height() - 1 - box.bottom()));
}

}  // namespace

void LineTool::change(const QLine& line) {
    if (line != state_.marks.line) emit changed(line);
}

void LineTool::hover(QPointF position) {
    grip_ = Grip::none;
    const QLine& line = state_.marks.line;
    if (!is_active() || line.isNull()) return;
    const auto& transform = state_.transform;
    const QPointF at = position * ratio(), start = transform.view_from_pixel(line.p1()),
                  end = transform.view_from_pixel(line.p2());
    const double to_start = distance_to_segment(at, start, start), to_end = distance_to_segment(at, end, end);
    if (std::min(to_start, to_end) <= end_reach * ratio())
        grip_ = to_start < to_end ? Grip::start : Grip::end;
    else if (distance_to_segment(at, start, end) <= line_reach * ratio())
        grip_ = Grip::whole;
}

void LineTool::move_to(QPointF pixel, bool constrain) {
    const QSize picture = picture_size();
    const QPoint to = pixel_of(pixel, picture);
    const auto end_at = [&](QPoint fixed) { return constrain ? straightened(fixed, to, picture) : to; };
    switch (grip_) {
        case Grip::none: {
            const QPoint start = pixel_of(from(), picture);
            return change({start, end_at(start)});
        }
        case Grip::start:
            return change({end_at(before_.p2()), before_.p2()});
        case Grip::end:
            return change({before_.p1(), end_at(before_.p1())});
        case Grip::whole: {
            QPoint by(int(std::lround(pixel.x() - from().x())), int(std::lround(pixel.y() - from().y())));
            if (constrain) std::abs(by.x()) >= std::abs(by.y()) ? by.setY(0) : by.setX(0);
            return change(moved(before_, by, picture));
        }
    }
}

bool LineTool::takes(const QKeyEvent& event) const {
    if (!is_active() || !is_shape_key(event)) return false;
    const bool draws = event.key() != Qt::Key_Escape && event.key() != Qt::Key_Delete;
    return draws || !state_.marks.line.isNull() || is_dragging();
}

void LineTool::nudge(QPoint step, bool resize) {
    const QSize picture = picture_size();
    const QLine& line = state_.marks.line;
    if (line.isNull()) {
        const int x = picture.width() / 2, y = picture.height() / 2;
        return change(step.x() != 0 ? QLine(0, y, picture.width() - 1, y)
                                    : QLine(x, 0, x, picture.height() - 1));
    }
    if (!resize) return change(moved(line, step, picture));
    const QPoint end = inside(line.p2() + step, picture);
    if (end != line.p1()) change({line.p1(), end});
}

Qt::CursorShape LineTool::cursor() const {
    return grip_ == Grip::none ? Qt::CrossCursor : Qt::SizeAllCursor;
}

}  // namespace ir::widgets
