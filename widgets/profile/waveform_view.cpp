#include "widgets/profile/waveform_view.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/image/display.h"

namespace ir::widgets {
namespace {

constexpr double space_between = 8, foot_height = 6;
constexpr int axis_parts = 4;
constexpr QRgb scope_black = 0xff141414;

QFont small_font(const QFont& font) {
    auto small = font;
    small.setPointSizeF(small.pointSizeF() * 0.85);
    return small;
}

double line_height(const QFont& font) {
    return QFontMetricsF(small_font(font)).height() + 4;
}

/// Of a value that occurs once, so that it is seen.
constexpr double least_brightness = 0.2;

std::array<int, 3> scope_colour(std::size_t channel, std::size_t channels) {
    if (channels == 1) return {225, 225, 225};
    constexpr std::array<std::array<int, 3>, 4> colours{
        {{255, 70, 60}, {60, 215, 80}, {80, 120, 255}, {150, 150, 150}}};
    return colours[std::min<std::size_t>(channel, 3)];
}

QImage scope_image(const Waveform& wave, bool logarithmic) {
    QImage image(std::max(1, wave.columns), Waveform::rows, QImage::Format_RGB32);
    image.fill(scope_black);
    const double most = std::max<double>(1, wave.most);
    for (int row = 0; row < Waveform::rows; ++row) {
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(Waveform::rows - 1 - row));
        for (int column = 0; column < wave.columns; ++column) {
            std::array<double, 3> sum{double(qRed(scope_black)), double(qGreen(scope_black)),
                                      double(qBlue(scope_black))};
            for (std::size_t c = 0; c < wave.channels.size(); ++c) {
                const auto count = wave.count(c, column, row);
                if (count == 0) continue;
                const double share = logarithmic ? std::log1p(count) / std::log1p(most) : count / most;
                const auto colour = scope_colour(c, wave.channels.size());
                for (std::size_t i = 0; i < 3; ++i)
                    sum[i] += colour[i] * (least_brightness + (1 - least_brightness) * share);
            }
            const auto byte = [](double value) { return int(std::min(255.0, value)); };
            line[column] = qRgb(byte(sum[0]), byte(sum[1]), byte(sum[2]));
        }
    }
    return image;
}

}  // namespace

WaveformView::WaveformView(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Waveforms"));
}

void WaveformView::set_waveforms(std::vector<Waveform> waveforms, bool logarithmic) {
    waveforms_ = std::move(waveforms);
    images_.clear();
    axis_width_ = 0;
    if (!waveforms_.empty())
        for (int i = 0; i <= axis_parts; ++i)
            axis_width_ =
                std::max(axis_width_, fontMetrics().horizontalAdvance(short_number(axis_value(i))) + 12.0);
    for (std::size_t i = 0; i < shown(); ++i) images_.push_back(scope_image(waveforms_[i], logarithmic));
    update();
}

QRectF WaveformView::place_of(std::size_t waveform) const {
    const double count = double(std::max<std::size_t>(1, shown()));
    const double wide = std::max(1.0, (width() - axis_width_ - space_between * count) / count);
    const double names = line_height(font());
    return {axis_width_ + double(waveform) * (wide + space_between), names, wide,
            std::max(1.0, height() - names - foot_height)};
}

double WaveformView::axis_value(int part) const {
    const auto& axis = waveforms_.front().axis;
    return axis.low + (axis.high - axis.low) * part / axis_parts;
}

void WaveformView::paint_axis(QPainter& painter) const {
    const QRectF area = place_of(0);
    const double line = line_height(font());
    const int step = area.height() > 7 * line ? 1 : 2;
    painter.setPen(palette().color(QPalette::Text));
    for (int i = 0; i <= axis_parts; i += step) {
        const double y = area.bottom() - area.height() * i / axis_parts;
        const QRectF box(0, std::clamp(y - line / 2, 0.0, std::max(0.0, height() - line)), axis_width_ - 6,
                         line);
        painter.drawText(box, Qt::AlignRight | Qt::AlignVCenter, short_number(axis_value(i)));
    }
}

void WaveformView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setFont(small_font(font()));
    if (waveforms_.empty()) {
        painter.setPen(palette().color(QPalette::PlaceholderText));
        painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, tr("No pixel has a value here."));
        return;
    }
    paint_axis(painter);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    for (std::size_t i = 0; i < shown(); ++i) {
        const QRectF area = place_of(i);
        QString name = QString::fromStdString(waveforms_[i].picture);
        if (i + 1 == shown() && waveforms_.size() > shown())
            name = tr("%1 (%2 more are not shown)").arg(name).arg(waveforms_.size() - shown());
        painter.setPen(palette().color(QPalette::Text));
        painter.drawText(QRectF(area.left(), 0, area.width(), area.top()), Qt::AlignVCenter,
                         painter.fontMetrics().elidedText(name, Qt::ElideMiddle, int(area.width())));
        painter.drawImage(area, images_[i]);
    }
}

QString WaveformView::text_at(QPointF place) const {
    for (std::size_t i = 0; i < shown(); ++i) {
        const QRectF area = place_of(i);
        if (!area.contains(place)) continue;
        const auto& wave = waveforms_[i];
        const int column =
            std::clamp(int((place.x() - area.left()) / area.width() * wave.columns), 0, wave.columns - 1);
        const int row = std::clamp(int((area.bottom() - place.y()) / area.height() * Waveform::rows), 0,
                                   Waveform::rows - 1);
        const double step = (wave.axis.high - wave.axis.low) / Waveform::rows;
        const int first = wave.pixel_of(column), last = wave.pixel_of(column + 1) - 1;
        QStringList lines{
            QString::fromStdString(wave.picture),
            first == last ? tr("Column %1").arg(first) : tr("Columns %1 to %2").arg(first).arg(last),
            tr("%1 … %2").arg(short_number(wave.axis.low + row * step),
                              short_number(wave.axis.low + (row + 1) * step))};
        for (std::size_t c = 0; c < wave.channels.size(); ++c) {
            const auto count = wave.count(c, column, row);
            const auto name = QString::fromStdString(wave.channels[c].name);
            lines << (name.isEmpty() ? tr("%1 pixels").arg(count) : tr("%1: %2 pixels").arg(name).arg(count));
        }
        return lines.join(QLatin1Char('\n'));
    }
    return {};
}

bool WaveformView::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip) return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto text = text_at(help->pos());
    QToolTip::showText(
        help->globalPos(),
        text.isEmpty() ? tr("Columns of the picture against their values; brighter is more often") : text,
        this);
    return true;
}

}  // namespace ir::widgets
