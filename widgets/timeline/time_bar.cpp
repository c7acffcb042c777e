#include "widgets/timeline/time_bar.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

constexpr double margin = 12, ruler_height = 22, lane_height = 16, key_radius = 4;
/// Of names on lines: how far they stay from keys, and how wide they are at least.
constexpr double name_gap = key_radius + 5, least_name = 32;
/// Further ones are not told apart by eye anyway.
constexpr std::size_t max_tracks = 8;

/// 1, 2 or 5 times a power of ten, so that labels stand at least `least` seconds apart.
double label_step(double min_step) {
    const double power = std::pow(10, std::floor(std::log10(min_step)));
    for (const double step : {1.0, 2.0, 5.0})
        if (step * power >= min_step) return step * power;
    return 10 * power;
}

QPainterPath diamond(QPointF centre, double radius) {
    QPainterPath path(centre + QPointF(0, -radius));
    path.lineTo(centre + QPointF(radius, 0));
    path.lineTo(centre + QPointF(0, radius));
    path.lineTo(centre + QPointF(-radius, 0));
    path.closeSubpath();
    return path;
}

}  // namespace

TimeBar::TimeBar(QWidget* parent) : QWidget(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Time"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Minimum);
}

void TimeBar::show_state(const TimelineState& state) {
    const bool other_height = state.tracks.size() != state_.tracks.size();
    state_ = state;
    if (other_height) updateGeometry();
    update();
}

QSize TimeBar::sizeHint() const {
    const auto lines = std::max<std::size_t>(1, std::min(state_.tracks.size(), max_tracks));
    return {400, int(ruler_height + double(lines) * lane_height + 6)};
}

QSize TimeBar::minimumSizeHint() const {
    return {120, sizeHint().height()};
}

double TimeBar::position_of(double time) const {
    return margin + (width() - 2 * margin) * time / std::max(state_.end, 1e-9);
}

double TimeBar::time_at(double x) const {
    const double time = (x - margin) / std::max(1.0, width() - 2 * margin) * state_.end;
    const double frame = std::round(std::clamp(time, 0.0, state_.end) * timeline_frames_per_second);
    return frame / timeline_frames_per_second;
}

double TimeBar::line_of(std::size_t track) const {
    return ruler_height + (double(track) + 0.5) * lane_height;
}

void TimeBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    paint_ruler(painter);
    paint_tracks(painter);
    paint_needle(painter);
    if (!hasFocus()) return;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(palette().color(QPalette::Highlight), 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
}

void TimeBar::paint_ruler(QPainter& painter) const {
    const double pixels_per_second = (width() - 2 * margin) / std::max(state_.end, 1e-9);
    const double step = label_step(64 / std::max(pixels_per_second, 1e-9));
    const QColor text = palette().color(QPalette::Text), dim = palette().color(QPalette::PlaceholderText);
    auto small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    painter.setFont(small);
    painter.setPen(QPen(dim, 1));
    painter.drawLine(QPointF(margin, ruler_height - 0.5), QPointF(width() - margin, ruler_height - 0.5));
    const bool shows_frames = pixels_per_second / timeline_frames_per_second >= 5;
    const double minor = shows_frames ? 1 / timeline_frames_per_second : step / 5;
    for (int i = 0; i * minor <= state_.end * (1 + 1e-9) && i < 10000; ++i) {
        const double x = std::round(position_of(i * minor)) + 0.5;
        painter.drawLine(QPointF(x, ruler_height - 4), QPointF(x, ruler_height - 1));
    }
    for (int i = 0; i * step <= state_.end * (1 + 1e-9) && i < 1000; ++i) {
        const double x = std::round(position_of(i * step)) + 0.5;
        painter.setPen(QPen(dim, 1));
        painter.drawLine(QPointF(x, ruler_height - 8), QPointF(x, ruler_height - 1));
        painter.setPen(text);
        const auto label = tr("%1 s").arg(i * step, 0, 'g', 6);
        const double wide = painter.fontMetrics().horizontalAdvance(label);
        const double left = std::clamp(x - wide / 2, 1.0, std::max(1.0, width() - wide - 1));
        painter.drawText(QPointF(left, ruler_height - 10), label);
    }
    painter.setFont(font());
}

void TimeBar::paint_tracks(QPainter& painter) const {
    const QColor line(120, 120, 120), key = theme_colours().warning;
    for (std::size_t i = 0; i < std::min(state_.tracks.size(), max_tracks); ++i) {
        const auto& track = state_.tracks[i];
        const double y = line_of(i);
        const double first = track.keys.empty() ? 0 : track.keys.front();
        const double last = track.keys.empty() ? track.end : track.keys.back();
        painter.setPen(QPen(line, track.keys.empty() ? 3 : 1.5));
        painter.drawLine(QPointF(position_of(first), y), QPointF(position_of(last), y));
        if (track.loop) {  // it goes on
            painter.setPen(QPen(line, 1, Qt::DotLine));
            painter.drawLine(QPointF(position_of(last), y), QPointF(width() - margin, y));
        }
        paint_name(painter, i);
        painter.setPen(QPen(palette().color(QPalette::Base), 1));
        painter.setBrush(key);
        for (const double time : track.keys)
            if (time >= 0 && time <= state_.end)
                painter.drawPath(diamond({position_of(time), y}, key_radius));
    }
}

/// In the first stretch of the line that has room between its keys.
void TimeBar::paint_name(QPainter& painter, std::size_t track) const {
    const auto& named = state_.tracks[track];
    if (named.name.isEmpty()) return;
    double left = margin, right = width() - margin;
    for (const double time : named.keys) {
        if (time < 0 || time > state_.end) continue;
        const double key = position_of(time);
        if (key - name_gap - left >= least_name) {
            right = key - name_gap;
            break;
        }
        left = key + name_gap;
    }
    if (right - left < least_name) return;
    auto small = font();
    small.setPixelSize(int(lane_height) - 5);
    painter.setFont(small);
    const auto text = painter.fontMetrics().elidedText(named.name, Qt::ElideRight, int(right - left));
    const QRectF place(left, line_of(track) - lane_height / 2, painter.fontMetrics().horizontalAdvance(text),
                       lane_height);
    painter.fillRect(place.adjusted(-2, 0, 2, 0), palette().color(QPalette::Base));
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, text);
    painter.setFont(font());
}

void TimeBar::paint_needle(QPainter& painter) const {
    const auto mark = [&](double time, const QColor& colour, double width, Qt::PenStyle style) {
        const double x = std::round(position_of(std::clamp(time, 0.0, state_.end))) + 0.5;
        painter.setPen(QPen(colour, width, style));
        painter.drawLine(QPointF(x, 2), QPointF(x, height() - 2));
        return x;
    };
    if (state_.is_elsewhere)
        mark(state_.own_time, palette().color(QPalette::PlaceholderText), 1, Qt::DashLine);
    const QColor colour = palette().color(QPalette::Link);
    const double x = mark(state_.time, colour, 1.5, Qt::SolidLine);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    QPainterPath head(QPointF(x - 5, ruler_height - 7));
    head.lineTo(x + 5, ruler_height - 7);
    head.lineTo(x, ruler_height);
    painter.drawPath(head);
}

void TimeBar::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton) emit time_chosen(time_at(event->position().x()));
}

void TimeBar::mouseMoveEvent(QMouseEvent* event) {
    const double time = time_at(event->position().x());
    if ((event->buttons() & Qt::LeftButton) && time != state_.time) emit time_chosen(time);
}

void TimeBar::keyPressEvent(QKeyEvent* event) {
    const int frames = event->modifiers() & Qt::ShiftModifier ? 10 : 1;
    switch (event->key()) {
        case Qt::Key_Left:
            return emit step_wanted(-frames);
        case Qt::Key_Right:
            return emit step_wanted(frames);
        case Qt::Key_Home:
            return emit time_chosen(0);
        case Qt::Key_End:
            return emit time_chosen(state_.end);
        case Qt::Key_Space:
            if (!event->isAutoRepeat()) emit play_toggled();
            return;
        default:
            QWidget::keyPressEvent(event);
    }
}

QString TimeBar::tip_at(const QPointF& place) const {
    for (std::size_t i = 0; i < std::min(state_.tracks.size(), max_tracks); ++i) {
        if (std::abs(place.y() - line_of(i)) > lane_height / 2) continue;
        const auto& track = state_.tracks[i];
        const QString what =
            tr("%1 moves %2%3").arg(track.name, track.what, track.loop ? tr(", in a loop") : QString());
        for (std::size_t k = 0; k < track.keys.size(); ++k)
            if (std::abs(place.x() - position_of(track.keys[k])) <= key_radius + 1)
                return tr("%1\nKey %2 of %3, at %4 s")
                    .arg(what)
                    .arg(k + 1)
                    .arg(track.keys.size())
                    .arg(track.keys[k]);
        return what;
    }
    return tr(
        "Drag to see another time: the history of frames begins anew there. Space plays, ← and → step a "
        "frame, Home and End go to the ends");
}

bool TimeBar::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), tip_at(help->pos()), this);
        return true;
    }
    return QWidget::event(event);
}

}  // namespace ir::widgets
