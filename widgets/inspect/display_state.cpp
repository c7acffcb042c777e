#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "widgets/inspect/colour_map_box.h"
#include "widgets/inspect/display_panel.h"
#include "widgets/inspect/histogram_view.h"
#include "widgets/parameters/number_field.h"

/// What the display panel shows, and how a choice travels.
namespace ir::widgets {

void DisplayPanel::set_image(const QString& name, Semantic semantic, const QString& unit,
                             std::shared_ptr<const Image> image) {
    auto picture = std::make_shared<Picture>();
    picture->image = std::move(image);
    picture->semantic = semantic;
    picture->label = name;
    picture->unit = unit;
    set_picture(std::move(picture));
}

void DisplayPanel::set_picture(std::shared_ptr<const Picture> picture) {
    if (picture && !picture->has_image()) picture.reset();
    picture_ = std::move(picture);
    QString title = tr("No buffer in the active view");
    if (picture_) {
        QString meaning = QString::fromStdString(to_string(picture_->semantic));
        if (!picture_->unit.isEmpty()) meaning += QStringLiteral(", ") + picture_->unit;
        title = QStringLiteral("<b>%1</b>&nbsp; %2×%3, %4")
                    .arg(picture_->label.toHtmlEscaped())
                    .arg(picture_->image->width)
                    .arg(picture_->image->height)
                    .arg(meaning.toHtmlEscaped());
    }
    title_->setText(title);
    title_->setToolTip(title);
    update_channels();
    update_controls();
}

void DisplayPanel::set_display(const Display& display, bool automatic) {
    display_ = display;
    automatic_ = automatic;
    update_controls();
}

void DisplayPanel::choose(const Display& display) {
    if (display == display_) return;
    display_ = display;
    automatic_ = false;
    update_controls();
    emit display_chosen(display_);
}

void DisplayPanel::fit(double low, double high) {
    Display display = display_;
    display.low = low;
    display.high = high;
    choose(display);
}

void DisplayPanel::fit_exposure() {
    const auto* counts = histogram_->current();
    if (!counts || counts->percentile_99 <= 0) return;
    Display display = display_;
    const double tenths = std::floor(-10 * std::log2(counts->percentile_99));
    display.exposure = std::clamp(tenths / 10, -40.0, 40.0);
    choose(display);
}

void DisplayPanel::update_channels() {
    const int channels = picture_ ? picture_->image->channels : 0;
    QStringList names{channels == 1 ? tr("Value") : tr("All")};
    for (int c = 0; channels > 1 && c < channels; ++c) names << channel_name(picture_->semantic, channels, c);
    QStringList shown;
    for (int i = 0; i < channel_->count(); ++i) shown << channel_->itemText(i);
    if (shown == names) return;
    channel_->clear();
    channel_->addItems(names);
}

void DisplayPanel::update_controls() {
    const auto show = [](const QList<QWidget*>& row, bool shown) {
        for (auto* widget : row) widget->setVisible(shown);
    };
    using Mode = Display::Mode;
    const bool ranged = display_.mode == Mode::vector || display_.mode == Mode::scalar;
    controls_->setEnabled(picture_ != nullptr);
    show(colour_rows_, display_.mode == Mode::colour);
    show(range_rows_, ranged);
    show(map_rows_, display_.mode == Mode::scalar);
    mode_->setCurrentIndex(int(display_.mode));
    channel_->setCurrentIndex(std::clamp(display_.channel + 1, 0, channel_->count() - 1));
    channel_->setEnabled(channel_->count() > 1);
    tone_map_->setCurrentIndex(int(display_.tone_map));
    map_->show_name(QString::fromStdString(display_.colour_map));
    exposure_->show_value(display_.exposure);
    low_->show_value(display_.low);
    high_->show_value(display_.high);
    {
        const QSignalBlocker quiet(exposure_slider_);
        const int steps = exposure_slider_->maximum() / 10;
        exposure_slider_->setValue(int(std::lround(display_.exposure * steps)));
    }
    marks_->setChecked(display_.mark_bad);
    negative_->setChecked(display_.negative_is_bad);
    negative_->setEnabled(display_.mark_bad);
    zebra_->setChecked(display_.zebra);
    zebra_->setEnabled(display_.mode != Mode::ids);
    hide_invalid_->setChecked(display_.hide_invalid);
    hide_invalid_->setEnabled(picture_ && picture_->valid);
    reset_->setEnabled(picture_ && !automatic_);
    reset_->setToolTip(automatic_ ? tr("Range and colours already come from the buffer's meaning and values")
                                  : tr("Choose range and colours from the buffer's meaning and values"));
    histogram_->set_picture(picture_, display_.channel);
    histogram_->set_range_shown(ranged);
    histogram_->set_range(display_.low, display_.high);
    update_counts();
}

void DisplayPanel::update_counts() {
    const auto* counts = histogram_->current();
    const bool known = counts && counts->finite > 0;
    QString text = histogram_->summary();
    if (known) text = tr("%1 to %2\n").arg(short_number(counts->min), short_number(counts->max)) + text;
    if (counts_->text() != text) counts_->setText(text);
    const auto set = [known](QPushButton* button, const QString& tip) {
        button->setEnabled(known);
        button->setToolTip(known ? tip
                                 : DisplayPanel::tr("There are no finite values, or they are being counted"));
    };
    set(fit_all_, tr("From the least to the greatest finite value"));
    set(fit_most_, tr("From the 1st to the 99th percentile of the finite values: ignores outliers"));
    set(fit_exposure_, tr("The exposure that makes the 99th percentile just white, in tenths of a stop"));
}

}  // namespace ir::widgets
