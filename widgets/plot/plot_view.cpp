#include "widgets/plot/plot_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <utility>

#include "widgets/plot/plot_painter.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr double reach = 12;  ///< logical pixels from the middle of a mark

using Mark = PlotDrawing::Mark;

/// From left to right, then from below; bars from the first row down.
bool is_before(const Mark& a, const Mark& b, bool are_bars) {
    if (are_bars) return a.y > b.y;
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

}  // namespace

PlotView::PlotView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setMinimumSize(min_size);
    setAccessibleName(tr("Plot"));
    setAccessibleDescription(
        tr("Left and right walk along a series, up and down go to another one, Enter "
           "takes over the chosen point"));
    follow_theme(this, [this] { lay_out(); });
}

void PlotView::set_data(const PlotData& data) {
    data_ = data;
    fit_rows();
    lay_out();
    if (!mark(selected_)) selected_.clear();
    if (!mark(hovered_)) hovered_.clear();
}

void PlotView::lay_out() {
    drawing_.emplace(data_, window_style(), width(), height(), true, PlotPainter(font()));
    update();
}

void PlotView::fit_rows() {
    const double wanted = PlotDrawing::height_of_rows(data_, PlotPainter(font()).line_height());
    setMinimumHeight(std::max(min_size.height(), int(std::ceil(wanted))));
}

void PlotView::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    lay_out();
}

void PlotView::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() != QEvent::FontChange) return;
    fit_rows();
    lay_out();
}

const Mark* PlotView::mark(const QString& id) const {
    const auto wanted = id.toStdString();
    const auto found =
        std::find_if(marks().begin(), marks().end(), [&](const Mark& each) { return each.id == wanted; });
    return id.isEmpty() || found == marks().end() ? nullptr : &*found;
}

void PlotView::show_selected(const QString& id) {
    selected_ = id;
    update();
}

void PlotView::hover(const QString& id) {
    if (hovered_ == id) return;
    hovered_ = id;
    update();
}

void PlotView::select(const QString& id) {
    show_selected(mark(id) ? id : QString());
}

void PlotView::choose(const QString& id) {
    if (id == selected_ || id.isEmpty()) return;
    show_selected(id);
    emit selected_changed(id);
}

QPointF PlotView::position_of(const QString& id) const {
    const auto* found = mark(id);
    if (!found) return {-1, -1};
    if (drawing_->has_boxes()) {
        const auto box = drawing_->box(*found);
        return {(box.left + box.right) / 2, (box.top + box.bottom) / 2};
    }
    const auto place = drawing_->place(*found);
    return {place.x, place.y};
}

QString PlotView::point_at(const QPointF& place) const {
    const PlotCanvas::Place at{place.x(), place.y()};
    double nearest = reach;
    QString found;
    for (const auto& mark : marks()) {
        if (drawing_->has_boxes()) {
            auto box = drawing_->box(mark);
            if (data_.are_bars) box.left -= reach / 2, box.right += reach / 2;
            if (box.contains(at)) return QString::fromStdString(mark.id);
            continue;
        }
        const auto [x, y] = drawing_->place(mark);
        const double distance = std::hypot(x - at.x, y - at.y);
        if (distance > nearest || (distance == nearest && !found.isEmpty())) continue;
        nearest = distance;
        found = QString::fromStdString(mark.id);
    }
    return found;
}

void PlotView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), colour_of(window_style().background));
    PlotPainter canvas(font(), &painter);
    drawing_->draw(canvas);
    drawing_->has_boxes() ? paint_chosen_boxes(painter) : paint_chosen_points(canvas);
    if (!hasFocus()) return;
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(1, 1, -1, -1));
}

void PlotView::paint_chosen_boxes(QPainter& painter) const {
    painter.setBrush(Qt::NoBrush);
    const auto surround = [&](const QString& id, double width) {
        const auto* chosen = mark(id);
        if (!chosen) return;
        const auto drawn = drawing_->box(*chosen);
        const auto frame = QRectF(drawn.left, drawn.top, drawn.width(), drawn.height());
        const auto box = data_.are_bars ? frame : frame.adjusted(1, 1, -1, -1);
        painter.setPen(QPen(colour_of(window_style().background), width + 2));
        painter.drawRect(box);
        painter.setPen(QPen(colour_of(window_style().selection), width));
        painter.drawRect(box);
    };
    surround(hovered_, 1);
    surround(selected_, 2.5);
}

void PlotView::paint_chosen_points(PlotCanvas& canvas) const {
    if (const auto* hovered = mark(hovered_)) drawing_->draw_mark(canvas, *hovered, 2);
    const auto* chosen = mark(selected_);
    if (!chosen) return;
    drawing_->draw_mark(canvas, *chosen, 1.5);
    canvas.shape(
        {drawing_->place(*chosen), drawing_->mark_radius() + 7, {}, {}, window_style().selection, 2.5, {}});
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
    hover(id);
    setCursor(id.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
    const auto* point = data().find(id.toStdString());
    if (point)
        QToolTip::showText(event->globalPosition().toPoint(), QString::fromStdString(point->label), this);
    else
        QToolTip::hideText();
}

void PlotView::leaveEvent(QEvent* event) {
    hover({});
    QWidget::leaveEvent(event);
}

/// The next point of the selected one's series, or the first of all.
QString PlotView::neighbour(int steps) const {
    const auto* now = mark(selected_);
    std::vector<const Mark*> row;
    for (const auto& each : marks())
        if (!now || each.series == now->series) row.push_back(&each);
    if (row.empty()) return {};
    std::stable_sort(row.begin(), row.end(),
                     [this](const Mark* a, const Mark* b) { return is_before(*a, *b, data_.are_bars); });
    if (!now) return QString::fromStdString(row.front()->id);
    const auto at = std::find(row.begin(), row.end(), now) - row.begin();
    const auto* to =
        row[std::size_t(std::clamp<std::ptrdiff_t>(at + steps, 0, std::ptrdiff_t(row.size()) - 1))];
    return QString::fromStdString(to->id);
}

/// The nearest point along x, of bars in the row, of the next series that has points.
QString PlotView::in_other_series(int steps) const {
    const auto* now = mark(selected_);
    if (!now) return neighbour(1);
    const int count = int(data().series.size());
    const auto distance = [&](const Mark& mark) {
        return data_.are_bars ? std::abs(mark.y - now->y) : std::abs(mark.x - now->x);
    };
    for (int i = 1; i < count; ++i) {
        const int series = ((now->series + steps * i) % count + count) % count;
        const Mark* nearest = nullptr;
        for (const auto& each : marks())
            if (each.series == series && (!nearest || distance(each) < distance(*nearest))) nearest = &each;
        if (nearest) return QString::fromStdString(nearest->id);
    }
    return QString::fromStdString(now->id);
}

void PlotView::keyPressEvent(QKeyEvent* event) {
    constexpr int all = 1 << 24;
    const bool are_bars = data_.are_bars;  // their series run downwards
    switch (event->key()) {
        case Qt::Key_Left:
            return choose(are_bars ? in_other_series(-1) : neighbour(-1));
        case Qt::Key_Right:
            return choose(are_bars ? in_other_series(1) : neighbour(1));
        case Qt::Key_Home:
            return choose(neighbour(-all));
        case Qt::Key_End:
            return choose(neighbour(all));
        case Qt::Key_Up:
            return choose(are_bars ? neighbour(-1) : in_other_series(-1));
        case Qt::Key_Down:
            return choose(are_bars ? neighbour(1) : in_other_series(1));
        case Qt::Key_Return:
        case Qt::Key_Enter:
            if (!selected_.isEmpty()) emit activated(selected_);
            return;
        default:
            return event->ignore();
    }
}

}  // namespace ir::widgets
