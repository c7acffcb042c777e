#include "widgets/plot/plot_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr double reach = 12;  ///< logical pixels from the middle of a mark

using Mark = PlotChart::Mark;

/// From left to right, then from below.
bool is_before(const Mark& a, const Mark& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

}  // namespace

PlotView::PlotView(QWidget* parent) : QWidget(parent), chart_(window_style()) {
    follow_theme(this, [this] {
        chart_.set_colours(window_style());
        update();
    });
    setAttribute(Qt::WA_OpaquePaintEvent);  // the chart fills its ground
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(220, 180);  // title, a line of the legend, both axes
    setAccessibleName(tr("Plot"));
    setAccessibleDescription(
        tr("Left and right walk along a series, up and down go to another one, Enter "
           "takes over the chosen point"));
}

void PlotView::set_data(const PlotData& data) {
    chart_.set_data(data);
    update();
}

void PlotView::select(const QString& id) {
    chart_.set_selected(chart_.mark(id) ? id : QString());
    update();
}

void PlotView::choose(const QString& id) {
    if (id == selected() || id.isEmpty()) return;
    chart_.set_selected(id);
    update();
    emit selected_changed(id);
}

QPointF PlotView::position_of(const QString& id) const {
    const auto* mark = chart_.mark(id);
    return mark ? chart_.position(*mark) : QPointF(-1, -1);
}

QString PlotView::point_at(const QPointF& place) const {
    if (chart_.is_heat()) {
        for (const auto& mark : chart_.marks())
            if (chart_.is_in_tile(mark, place)) return QString::fromStdString(mark.id);
        return {};
    }
    double nearest = reach;
    QString found;
    for (const auto& mark : chart_.marks()) {
        const QPointF apart = chart_.position(mark) - place;
        const double distance = std::hypot(apart.x(), apart.y());
        if (distance > nearest || (distance == nearest && !found.isEmpty())) continue;
        nearest = distance;
        found = QString::fromStdString(mark.id);
    }
    return found;
}

void PlotView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return event->ignore();
    pressed_ = point_at(event->position());
    choose(pressed_);
}

void PlotView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return event->ignore();
    const auto pressed = std::exchange(pressed_, QString());
    if (!pressed.isEmpty() && point_at(event->position()) == pressed) emit activated(pressed);
}

void PlotView::mouseMoveEvent(QMouseEvent* event) {
    const auto id = point_at(event->position());
    if (chart_.set_hovered(id)) update();
    setCursor(id.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
    const auto* point = data().find(id.toStdString());
    if (point)
        QToolTip::showText(event->globalPosition().toPoint(), QString::fromStdString(point->label), this);
    else
        QToolTip::hideText();
}

void PlotView::leaveEvent(QEvent* event) {
    if (chart_.set_hovered({})) update();
    QWidget::leaveEvent(event);
}

/// The next point of the selected one's series, or the first of all.
QString PlotView::neighbour(int steps) const {
    const auto* now = chart_.mark(selected());
    std::vector<const Mark*> row;
    for (const auto& mark : chart_.marks())
        if (!now || mark.series == now->series) row.push_back(&mark);
    if (row.empty()) return {};
    std::stable_sort(row.begin(), row.end(), [](const Mark* a, const Mark* b) { return is_before(*a, *b); });
    if (!now) return QString::fromStdString(row.front()->id);
    const auto at = std::find(row.begin(), row.end(), now) - row.begin();
    const auto* to =
        row[std::size_t(std::clamp<std::ptrdiff_t>(at + steps, 0, std::ptrdiff_t(row.size()) - 1))];
    return QString::fromStdString(to->id);
}

/// The nearest point along x of the next series that has points.
QString PlotView::in_other_series(int steps) const {
    const auto* now = chart_.mark(selected());
    if (!now) return neighbour(1);
    const int count = int(data().series.size());
    for (int i = 1; i < count; ++i) {
        const int series = ((now->series + steps * i) % count + count) % count;
        const Mark* nearest = nullptr;
        for (const auto& mark : chart_.marks())
            if (mark.series == series &&
                (!nearest || std::abs(mark.x - now->x) < std::abs(nearest->x - now->x)))
                nearest = &mark;
        if (nearest) return QString::fromStdString(nearest->id);
    }
    return QString::fromStdString(now->id);
}

void PlotView::keyPressEvent(QKeyEvent* event) {
    constexpr int all = 1 << 24;
    switch (event->key()) {
        case Qt::Key_Left:
            return choose(neighbour(-1));
        case Qt::Key_Right:
            return choose(neighbour(1));
        case Qt::Key_Home:
            return choose(neighbour(-all));
        case Qt::Key_End:
            return choose(neighbour(all));
        case Qt::Key_Up:
            return choose(in_other_series(-1));
        case Qt::Key_Down:
            return choose(in_other_series(1));
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (!selected().isEmpty()) emit activated(selected());
            return;
        default:
            return event->ignore();
    }
}

void PlotView::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    update();
}

void PlotView::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    update();
}

void PlotView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    chart_.set_size(size());
}

void PlotView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    chart_.paint(painter);
    if (!hasFocus()) return;
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

}  // namespace ir::widgets
