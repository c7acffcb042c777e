#include "widgets/panels/value_strip.h"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QRect>

namespace ir::widgets {

QString pixel_text(const Image& image, QPoint pixel, Semantic semantic, const QString& unit) {
    if (!QRect(0, 0, image.width, image.height).contains(pixel)) return {};
    QString text = QStringLiteral("x %1  y %2 ").arg(pixel.x(), 4).arg(pixel.y(), 4);
    for (int c = 0; c < image.channels; ++c)
        text += QStringLiteral("  %1 %2").arg(channel_name(semantic, image.channels, c),
                                              QString::number(image.at(pixel.x(), pixel.y(), c), 'g', 6));
    return unit.isEmpty() ? text : text + QLatin1Char(' ') + unit;
}

ValueStrip::ValueStrip(QWidget* parent)
    : QWidget(parent), values_(new QLabel(this)), zoom_(new QLabel(this)) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 2, 8, 2);
    layout->addWidget(values_, 1);
    layout->addWidget(zoom_);
    values_->setObjectName(QStringLiteral("values"));
    values_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    values_->setMinimumWidth(1);  // a long line must not widen the window
    const QFont mono = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    values_->setFont(mono);
    zoom_->setFont(mono);
    zoom_->setToolTip(tr("Zoom: screen pixels per picture pixel"));
}

void ValueStrip::set_picture(const Image& image, Semantic semantic, const QString& name,
                             const QString& unit) {
    statistics_ = statistics(image);
    semantic_ = semantic;
    name_ = name;
    unit_ = unit;
    size_ = {image.width, image.height};
    channels_ = image.channels;
    values_->setText(summary());
}

QString ValueStrip::summary() const {
    if (size_.isEmpty()) return name_;
    QString text = QStringLiteral("%1  %2×%3×%4   min %5  max %6  mean %7")
                       .arg(name_)
                       .arg(size_.width())
                       .arg(size_.height())
                       .arg(channels_)
                       .arg(short_number(statistics_.min), short_number(statistics_.max),
                            short_number(statistics_.mean));
    if (!unit_.isEmpty()) text += QLatin1Char(' ') + unit_;
    if (statistics_.nan) text += tr("   %1 NaN").arg(statistics_.nan);
    if (statistics_.infinite) text += tr("   %1 Inf").arg(statistics_.infinite);
    return text;
}

void ValueStrip::show_pixel(const Image& image, QPoint pixel) {
    // The cursor may rest where a smaller picture has no pixel.
    const auto text = pixel_text(image, pixel, semantic_, unit_);
    values_->setText(text.isEmpty() ? summary() : text);
}

void ValueStrip::set_zoom(double zoom) {
    zoom_->setText(QStringLiteral("%1 %").arg(zoom * 100, 0, 'f', zoom < 0.1 ? 1 : 0));
}

QString ValueStrip::text() const {
    return values_->text();
}

}  // namespace ir::widgets
