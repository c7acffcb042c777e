#include "widgets/inspect/histogram_view.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "widgets/image/display.h"

namespace ir::widgets {
namespace {

constexpr double reach = 7;  ///< pixels around a handle that take hold of it

}  // namespace

HistogramView::HistogramView(QWidget* parent) : QWidget(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::MinimumExpanding);
    setAccessibleName(tr("Histogram"));
}

HistogramView::~HistogramView() {
    cancelled_ = true;
    worker_.finish();
}

void HistogramView::set_image(std::shared_ptr<const Image> image, Semantic semantic, int channel) {
    auto picture = std::make_shared<Picture>();
    picture->image = std::move(image);
    picture->semantic = semantic;
    set_picture(std::move(picture), channel);
}

void HistogramView::set_picture(std::shared_ptr<const Picture> picture, int channel) {
    if (picture && !picture->has_image()) picture.reset();
    const auto same_pixels = [&] {
        if (!picture || !picture_) return picture == picture_;
        return picture->image == picture_->image && picture->valid == picture_->valid &&
               picture->atlas.tiles == picture_->atlas.tiles;
    };
    const auto same_kind = [&] {
        return picture && picture_ && picture->semantic == picture_->semantic && channel == channel_ &&
               picture->size() == picture_->size() && picture->image->channels == picture_->image->channels &&
               picture->label == picture_->label;
    };
    const bool recount = !same_pixels() || channel != channel_;
    if (!same_kind()) {
        ++generation_;
        zoom_.reset();
        if (recount) histogram_ = {};  // bars of another buffer would mislead even greyed
    }
    picture_ = std::move(picture);
    channel_ = channel;
    recount ? count() : update();
}

Histogram HistogramView::count_picture(const Picture& picture, int channel, const std::optional<Axis>& axis,
                                       const std::atomic<bool>* cancelled) {
    const Counted counted{picture.valid.get(), picture.atlas, picture.semantic};
    return ir::widgets::histogram(*picture.image, channel, axis, counted, cancelled);
}

void HistogramView::count() {
    ++serial_;
    counted_ = false;
    update();
    if (!picture_) return;
    if (picture_->image->pixels.size() > at_once) return start();
    histogram_ = count_picture(*picture_, channel_, zoom_, nullptr);
    counted_ = true;
    emit counted();
}

void HistogramView::start() {
    // One at a time, and the running one is let finish: frames that come faster than they are counted would
    // else never be.
    if (running_) return;
    running_ = true;
    worker_.start([this, picture = picture_, channel = channel_, zoom = zoom_, serial = serial_,
                   generation = generation_] {
        Histogram result = count_picture(*picture, channel, zoom, &cancelled_);
        if (cancelled_) return;
        QMetaObject::invokeMethod(
            this,
            [this, serial, generation, result = std::move(result)]() mutable {
                take(serial, generation, std::move(result));
            },
            Qt::QueuedConnection);
    });
}

void HistogramView::take(std::uint64_t serial, std::uint64_t generation, Histogram result) {
    running_ = false;
    if (serial == serial_) {
        histogram_ = std::move(result);
        counted_ = true;
        update();
        emit counted();
    } else if (picture_ && !counted_) {
        // Frames that come faster than they are counted: show that of a moment ago, still marked as such.
        if (generation == generation_) histogram_ = std::move(result);
        update();
        start();
    }
}

void HistogramView::set_range(double low, double high) {
    if (low == low_ && high == high_) return;
    low_ = low;
    high_ = high;
    update();
}

void HistogramView::set_range_shown(bool shown) {
    range_shown_ = shown;
    update();
}

void HistogramView::set_logarithmic(bool on) {
    logarithmic_ = on;
    update();
}

QString HistogramView::summary() const {
    if (!picture_) return tr("No image");
    if (!counted_) return tr("Counting …");
    const auto values = histogram_.finite + histogram_.nan + histogram_.infinite;
    const auto valid = valid_pixels(histogram_.valid, histogram_.pixels);
    QStringList parts;
    if (valid.isEmpty() || values != histogram_.valid) parts << tr("%1 values").arg(values);
    const auto add = [&parts](std::size_t count, const QString& what) {
        if (count > 0) parts << QStringLiteral("%1 %2").arg(count).arg(what);
    };
    add(histogram_.nan, tr("NaN"));
    add(histogram_.infinite, tr("Inf"));
    add(histogram_.negative, tr("negative"));
    add(histogram_.below + histogram_.above, tr("beyond the axis"));
    if (!valid.isEmpty()) parts << valid;
    return parts.join(QStringLiteral(", "));
}

QRectF HistogramView::plot() const {
    const double labels = fontMetrics().height() + 4;
    return QRectF(rect()).adjusted(9, 6, -9, -labels);
}

double HistogramView::x_of(double value) const {
    const QRectF box = plot();
    const Axis& axis = histogram_.axis;
    return box.left() + (value - axis.low) / (axis.high - axis.low) * box.width();
}

double HistogramView::value_at(double x) const {
    const QRectF box = plot();
    const Axis& axis = histogram_.axis;
    return axis.low + (x - box.left()) / box.width() * (axis.high - axis.low);
}

double HistogramView::handle_x(double value) const {
    return std::clamp(x_of(value), plot().left(), plot().right());
}

HistogramView::Handle HistogramView::handle_at(QPointF position) const {
    if (!range_shown_ || !picture_) return Handle::none;
    const double to_low = std::abs(position.x() - handle_x(low_));
    const double to_high = std::abs(position.x() - handle_x(high_));
    if (std::min(to_low, to_high) > reach) return Handle::none;
    if (to_low == to_high) return position.x() < handle_x(low_) ? Handle::low : Handle::high;
    return to_low < to_high ? Handle::low : Handle::high;
}

void HistogramView::move_handle(Handle handle, double value) {
    active_ = handle;
    (handle == Handle::low ? low_ : high_) = value;
    update();
    emit range_dragged(low_, high_);
}

void HistogramView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    dragged_ = handle_at(event->position());
    if (dragged_ != Handle::none) active_ = dragged_;
    update();
}

void HistogramView::mouseMoveEvent(QMouseEvent* event) {
    if (dragged_ == Handle::none)
        return setCursor(handle_at(event->position()) == Handle::none ? Qt::ArrowCursor : Qt::SizeHorCursor);
    move_handle(dragged_, value_at(event->position().x()));
}

void HistogramView::mouseReleaseEvent(QMouseEvent*) {
    dragged_ = Handle::none;
}

void HistogramView::mouseDoubleClickEvent(QMouseEvent*) {
    const Axis all{histogram_.min, histogram_.max};
    ++generation_;
    zoom_ = all.high > all.low && histogram_.axis != all ? std::optional(all) : std::nullopt;
    count();
}

void HistogramView::wheelEvent(QWheelEvent* event) {
    if (!current() || histogram_.finite == 0 || event->angleDelta().y() == 0) return event->ignore();
    const double factor = std::pow(0.8, event->angleDelta().y() / 120.0);
    const double centre = value_at(std::clamp(event->position().x(), plot().left(), plot().right()));
    const Axis axis{centre + (histogram_.axis.low - centre) * factor,
                    centre + (histogram_.axis.high - centre) * factor};
    // Narrower than a float resolves, or wider than any image: leave it.
    const double width = axis.high - axis.low;
    if (width > std::max(std::abs(centre), 1e-30) * 1e-6 && width < 1e30) {
        ++generation_;
        zoom_ = axis;
        count();
    }
    event->accept();
}

void HistogramView::keyPressEvent(QKeyEvent* event) {
    const double step = (histogram_.axis.high - histogram_.axis.low) / 100;
    const int direction = event->key() == Qt::Key_Right ? 1 : event->key() == Qt::Key_Left ? -1 : 0;
    if (direction != 0 && range_shown_ && picture_)
        return move_handle(active_, (active_ == Handle::low ? low_ : high_) + direction * step);
    if (event->key() == Qt::Key_Up || event->key() == Qt::Key_Down) {
        active_ = active_ == Handle::low ? Handle::high : Handle::low;
        return update();
    }
    QWidget::keyPressEvent(event);
}

bool HistogramView::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), bin_text(help->pos().x()), this);
        return true;
    }
    return QWidget::event(event);
}

QString HistogramView::bin_text(double x) const {
    if (!current() || histogram_.finite == 0 || x < plot().left() || x > plot().right()) return {};
    const Axis& axis = histogram_.axis;
    const double width = (axis.high - axis.low) / Histogram::bins;
    const int bin = std::clamp(int((value_at(x) - axis.low) / width), 0, Histogram::bins - 1);
    QStringList lines{
        tr("%1 to %2").arg(short_number(axis.low + bin * width), short_number(axis.low + (bin + 1) * width))};
    for (std::size_t c = 0; c < histogram_.channels.size(); ++c)
        lines << QStringLiteral("%1: %2")
                     .arg(channel_name(picture_->semantic, picture_->image->channels, histogram_.channels[c]))
                     .arg(histogram_.counts[c][std::size_t(bin)]);
    if (range_shown_) lines << tr("Drag the handles to choose the range; arrow keys move them too.");
    lines << tr("Wheel: zoom the axis. Double click: all values, then the bulk of them.");
    return lines.join(QLatin1Char('\n'));
}

}  // namespace ir::widgets
