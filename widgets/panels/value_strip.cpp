#include "widgets/panels/value_strip.h"

#include <QFontDatabase>
#include <QFontMetrics>
#include <QHBoxLayout>
#include <QLabel>
#include <QRect>

namespace ir::widgets {

namespace {

/// "  R 0.25  G 0.5  B 1 W/(m² sr)" of a pixel that the image has.
QString channels_text(const Image& image, QPoint pixel, Semantic semantic, const QString& unit) {
    QString text;
    for (int c = 0; c < image.channels; ++c)
        text += QStringLiteral("  %1 %2").arg(channel_name(semantic, image.channels, c),
                                              QString::number(image.at(pixel.x(), pixel.y(), c), 'g', 6));
    return unit.isEmpty() ? text : text + QLatin1Char(' ') + unit;
}

}  // namespace

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
    values_->setTextFormat(Qt::PlainText);
    zoom_->setFont(mono);
    zoom_->setToolTip(tr("Zoom: screen pixels per picture pixel"));
}

void ValueStrip::set_picture(const Image& image, Semantic semantic, const QString& name, const QString& unit,
                             const Atlas& atlas, const Image* valid) {
    statistics_ = statistics(image, semantic, atlas, -1, valid);
    semantic_ = semantic;
    name_ = name;
    unit_ = unit;
    size_ = {image.width, image.height};
    channels_ = image.channels;
    say(summary(), true);
}

QString ValueStrip::summary(int statistics, bool named) const {
    if (size_.isEmpty()) return name_;
    QString text = QStringLiteral("%1×%2×%3 ").arg(size_.width()).arg(size_.height()).arg(channels_);
    if (named) text.prepend(name_ + QStringLiteral("  "));
    const QString fields[] = {QStringLiteral("  min ") + short_number(statistics_.min),
                              QStringLiteral("  max ") + short_number(statistics_.max),
                              QStringLiteral("  mean ") + short_number(statistics_.mean)};
    for (int i = 0; i < statistics; ++i) text += fields[i];
    if (!unit_.isEmpty() && statistics > 0) text += QLatin1Char(' ') + unit_;
    const auto valid = valid_pixels(statistics_.valid, statistics_.pixels);
    if (!valid.isEmpty() && statistics > 0) text += QStringLiteral("   ") + valid;
    if (statistics_.nan) text += tr("   %1 NaN").arg(statistics_.nan);
    if (statistics_.infinite) text += tr("   %1 Inf").arg(statistics_.infinite);
    return text;
}

void ValueStrip::say(const QString& full, bool is_summary) {
    full_ = full;
    is_summary_ = is_summary;
    update_line();
}

/// Whole fields go rather than digits: half a number would be read as another one. The name goes first:
/// the view's title has it.
void ValueStrip::update_line() {
    const QFontMetrics metrics(values_->font());
    const auto fits = [&](const QString& line) {
        return metrics.horizontalAdvance(line) <= values_->width();
    };
    QString line = full_;
    for (int statistics = 3; is_summary_ && statistics >= 0 && !fits(line); --statistics)
        line = summary(statistics, false);
    if (!fits(line)) line = metrics.elidedText(line, Qt::ElideRight, values_->width());
    if (line != values_->text()) values_->setText(line);
    values_->setToolTip(full_);
}

void ValueStrip::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    layout()->activate();  // the line gets its width first
    update_line();
}

void ValueStrip::show_pixel(const Picture& picture, QPoint pixel, const QString& who) {
    // The cursor may rest where a smaller picture has no pixel.
    const auto place = place_text(picture, pixel);
    if (place.isEmpty()) return say(summary(), true);
    say((who.isEmpty() ? QString() : who + QStringLiteral("   ")) + place + QLatin1Char(' ') +
            channels_text(*picture.image, pixel, picture.semantic, picture.unit),
        false);
}

void ValueStrip::set_zoom(double zoom) {
    zoom_->setText(QStringLiteral("%1 %").arg(zoom * 100, 0, 'f', zoom < 0.1 ? 1 : 0));
    layout()->activate();
    update_line();
}

}  // namespace ir::widgets
