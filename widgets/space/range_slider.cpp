#include "widgets/space/range_slider.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace ir::widgets {
namespace {

constexpr double handle_width = 9, handle_height = 16, track_height = 4;
/// From the widget's side to the middle of a handle at the end of the track.
constexpr double side = 7;

}  // namespace

RangeSlider::RangeSlider(QWidget* parent) : QWidget(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setMouseTracking(true);
    setToolTip(
        tr("Drag a handle, or between them to move both.\n"
           "Left and Right step the range; with Shift its upper end, with Ctrl its lower end.\n"
           "Home and End: the first and last alone. Double click: everything."));
}

QSize RangeSlider::sizeHint() const {
    return {160, 24};
}

void RangeSlider::set_limits(double min, double max, bool whole) {
    std::tie(min_, max_) = std::minmax(min, max);
    whole_ = whole;
    update();
}

void RangeSlider::set_range(double low, double high) {
    low_ = std::min(low, high);
    high_ = std::max(low, high);
    update();
}

double RangeSlider::step_size() const {
    return whole_ ? 1 : (max_ - min_) / 100;
}

double RangeSlider::position_of(double value) const {
    const double share = max_ > min_ ? std::clamp((value - min_) / (max_ - min_), 0.0, 1.0) : 0.5;
    return side + share * (width() - 2 * side);
}

double RangeSlider::value_at(double x) const {
    const double share = (x - side) / std::max(1.0, width() - 2 * side);
    return min_ + share * (max_ - min_);
}

void RangeSlider::choose(double low, double high) {
    const auto snapped = [&](double value) { return whole_ ? std::round(value) : value; };
    low = std::clamp(snapped(low), min_, max_);
    high = std::clamp(snapped(high), min_, max_);
    if (low == low_ && high == high_) return;
    low_ = low;
    high_ = high;
    update();
    emit range_chosen(low_, high_);
}

void RangeSlider::choose_all() {
    choose(min_, max_);
}

void RangeSlider::step(int steps) {
    if (steps == 0) return;
    if (is_all()) {
        const double end = steps > 0 ? min_ : max_;
        const double other = whole_ ? end : end + (steps > 0 ? 1 : -1) * 10 * step_size();
        return choose(std::min(end, other), std::max(end, other));
    }
    // The width stays: at an end the range stops instead of shrinking.
    const double wanted = steps * step_size();
    const double shift = std::clamp(wanted, std::min(0.0, min_ - low_), std::max(0.0, max_ - high_));
    choose(low_ + shift, high_ + shift);
}

void RangeSlider::step_end(Part part, int steps) {
    const double shift = steps * step_size();
    if (part == Part::low) choose(std::min(low_ + shift, high_), high_);
    if (part == Part::high) choose(low_, std::max(high_ + shift, low_));
}

RangeSlider::Part RangeSlider::part_at(double x) const {
    const double left = position_of(low_), right = position_of(high_), reach = handle_width / 2 + 2;
    const bool on_left = std::abs(x - left) <= reach, on_right = std::abs(x - right) <= reach;
    // Handles that lie upon each other: the outer half of each takes it.
    if (on_left && on_right) return x <= (left + right) / 2 ? Part::low : Part::high;
    if (on_left) return Part::low;
    if (on_right) return Part::high;
    if (x > left && x < right) return Part::both;
    return x < left ? Part::low : Part::high;
}

void RangeSlider::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !(max_ > min_)) return;
    const double x = event->position().x();
    dragged_ = part_at(x);
    press_value_ = value_at(x);
    press_low_ = low_;
    press_high_ = high_;
    // Beside the range its nearer end comes to the cursor.
    if (x < position_of(low_) - handle_width) choose(press_value_, high_);
    if (x > position_of(high_) + handle_width) choose(low_, press_value_);
    press_low_ = low_;
    press_high_ = high_;
    update();
}

void RangeSlider::mouseMoveEvent(QMouseEvent* event) {
    const double value = value_at(event->position().x());
    const double moved = value - press_value_;
    if (dragged_ == Part::low) choose(std::min(value, high_), high_);
    if (dragged_ == Part::high) choose(low_, std::max(value, low_));
    if (dragged_ == Part::both) {
        const double shift = std::clamp(moved, min_ - press_low_, max_ - press_high_);
        choose(press_low_ + shift, press_high_ + shift);
    }
    if (dragged_ == Part::none) {
        const Part part = part_at(event->position().x());
        setCursor(part == Part::both && !is_all() ? Qt::SizeAllCursor : Qt::SizeHorCursor);
    }
}

void RangeSlider::mouseReleaseEvent(QMouseEvent*) {
    dragged_ = Part::none;
    update();
}

void RangeSlider::mouseDoubleClickEvent(QMouseEvent*) {
    choose_all();
}

void RangeSlider::wheelEvent(QWheelEvent* event) {
    if (!hasFocus()) return event->ignore();  // the page scrolls
    const int steps = event->angleDelta().y() / 120;
    event->accept();
    step(steps);
}

void RangeSlider::keyPressEvent(QKeyEvent* event) {
    const int direction = event->key() == Qt::Key_Right || event->key() == Qt::Key_Up    ? 1
                          : event->key() == Qt::Key_Left || event->key() == Qt::Key_Down ? -1
                                                                                         : 0;
    const double alone = whole_ ? 0 : 10 * step_size();
    if (event->key() == Qt::Key_Home) return choose(min_, min_ + alone);
    if (event->key() == Qt::Key_End) return choose(max_ - alone, max_);
    if (direction == 0) return QWidget::keyPressEvent(event);
    if (event->modifiers() & Qt::ShiftModifier) return step_end(Part::high, direction);
    if (event->modifiers() & Qt::ControlModifier) return step_end(Part::low, direction);
    step(direction);
}

void RangeSlider::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const auto group = isEnabled() ? QPalette::Active : QPalette::Disabled;
    const double middle = height() / 2.0, left = position_of(low_), right = position_of(high_);
    const auto bar = [&](double from, double to, const QColor& colour) {
        painter.setPen(Qt::NoPen);
        painter.setBrush(colour);
        painter.drawRoundedRect(QRectF(from, middle - track_height / 2, to - from, track_height), 2, 2);
    };
    bar(side - 3, width() - side + 3, palette().color(group, QPalette::Base));
    bar(left, right,
        isEnabled() ? palette().color(group, QPalette::Highlight) : palette().color(group, QPalette::Mid));
    const auto handle = [&](double x, Part part) {
        const bool held = dragged_ == part || dragged_ == Part::both;
        painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Link : QPalette::Shadow), 1));
        painter.setBrush(palette().color(group, held ? QPalette::Light : QPalette::Button).lighter(150));
        painter.drawRoundedRect(
            QRectF(x - handle_width / 2, middle - handle_height / 2, handle_width, handle_height), 2.5, 2.5);
    };
    handle(left, Part::low);
    handle(right, Part::high);
}

}  // namespace ir::widgets
