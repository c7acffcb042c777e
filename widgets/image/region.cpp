#include "widgets/image/region.h"

#include <algorithm>
#include <cmath>

namespace ir::widgets {
namespace {

int rounded(double value) {
    return int(std::lround(value));
}

/// -1 near the first edge, 1 near the second, 0 elsewhere; of two edges that are close the nearer one.
int edge_at(double at, double first, double second, double reach) {
    const double to_first = std::abs(at - first), to_second = std::abs(at - second);
    if (std::min(to_first, to_second) > reach) return 0;
    return to_first < to_second ? -1 : 1;
}

/// Edges of one axis, exclusive end.
struct Span {
    int first, end;
};

Span dragged_span(Span span, int edge, double delta, int size) {
    if (edge < 0) span.first = std::clamp(rounded(span.first + delta), 0, span.end - 1);
    if (edge > 0) span.end = std::clamp(rounded(span.end + delta), span.first + 1, size);
    return span;
}

/// The other extent follows from the proportions; where the picture ends both are shorter.
void keep_proportions(Span& x, Span& y, const QRect& before, RegionGrip grip, QSize picture) {
    const double aspect = double(before.width()) / before.height();
    double width = std::max(double(x.end - x.first), (y.end - y.first) * aspect);
    width = std::min(width, double(grip.x < 0 ? x.end : picture.width() - x.first));
    width = std::min(width, aspect * (grip.y < 0 ? y.end : picture.height() - y.first));
    const int w = std::max(1, rounded(width)), h = std::max(1, rounded(width / aspect));
    grip.x < 0 ? void(x.first = x.end - w) : void(x.end = x.first + w);
    grip.y < 0 ? void(y.first = y.end - h) : void(y.end = y.first + h);
}

}  // namespace

RegionGrip grip_at(const QRect& region, const ViewTransform& transform, QPointF at, double reach) {
    if (region.isEmpty()) return {};
    const QPointF from = transform.view_from_image(region.topLeft());
    const QPointF to = transform.view_from_image(region.bottomRight() + QPoint(1, 1));
    if (at.x() < from.x() - reach || at.x() > to.x() + reach || at.y() < from.y() - reach ||
        at.y() > to.y() + reach)
        return {};
    RegionGrip grip;
    // A small rectangle must still be movable: its edges reach inwards by a quarter at most.
    const auto inwards = [&](double first, double second) {
        return std::max(std::min(reach, (second - first) / 4), 1.0);
    };
    const auto edge = [&](double value, double first, double second) {
        const bool outside = value < first || value > second;
        return edge_at(value, first, second, outside ? reach : inwards(first, second));
    };
    grip.x = edge(at.x(), from.x(), to.x());
    grip.y = edge(at.y(), from.y(), to.y());
    grip.inside = grip.x == 0 && grip.y == 0;
    return grip;
}

QRect drawn_region(QPointF from, QPointF to, bool square, QSize picture) {
    const auto pixel = [](QPointF at) { return QPoint(int(std::floor(at.x())), int(std::floor(at.y()))); };
    QPoint first = pixel(from), last = pixel(to);
    if (square) {
        const int x = last.x() < first.x() ? -1 : 1, y = last.y() < first.y() ? -1 : 1;
        int side = std::max(std::abs(last.x() - first.x()), std::abs(last.y() - first.y()));
        side = std::min(side, x < 0 ? first.x() : picture.width() - 1 - first.x());
        side = std::min(side, y < 0 ? first.y() : picture.height() - 1 - first.y());
        last = first + std::max(0, side) * QPoint(x, y);
    }
    const QRect all(QPoint(std::min(first.x(), last.x()), std::min(first.y(), last.y())),
                    QPoint(std::max(first.x(), last.x()), std::max(first.y(), last.y())));
    return all & QRect(QPoint(0, 0), picture);
}

QRect dragged_region(const QRect& region, RegionGrip grip, QPointF delta, bool constrain, QSize picture) {
    if (grip.none() || region.isEmpty()) return region;
    if (grip.inside) {
        QPoint by(rounded(delta.x()), rounded(delta.y()));
        if (constrain) std::abs(delta.x()) >= std::abs(delta.y()) ? by.setY(0) : by.setX(0);
        return nudged_region(region, by, picture);
    }
    Span x = dragged_span({region.left(), region.right() + 1}, grip.x, delta.x(), picture.width());
    Span y = dragged_span({region.top(), region.bottom() + 1}, grip.y, delta.y(), picture.height());
    if (constrain && grip.x != 0 && grip.y != 0) keep_proportions(x, y, region, grip, picture);
    return {x.first, y.first, x.end - x.first, y.end - y.first};
}

QRect nudged_region(const QRect& region, QPoint by, QSize picture) {
    if (region.isEmpty()) return region;
    return {QPoint(std::clamp(region.left() + by.x(), 0, std::max(0, picture.width() - region.width())),
                   std::clamp(region.top() + by.y(), 0, std::max(0, picture.height() - region.height()))),
            region.size()};
}

QRect grown_region(const QRect& region, QPoint by, QSize picture) {
    if (region.isEmpty()) return region;
    return {region.topLeft(),
            QSize(std::clamp(region.width() + by.x(), 1, std::max(1, picture.width() - region.left())),
                  std::clamp(region.height() + by.y(), 1, std::max(1, picture.height() - region.top())))};
}

}  // namespace ir::widgets
