#include "widgets/panels/display_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "renderers/image/colour_map.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {

DisplayBar::DisplayBar(QWidget* parent) : QWidget(parent) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(8, 3, 8, 3);
    row->setSpacing(6);
    const auto add_field = [&](const QString& tip, double Display::*member) {
        auto* field = new NumberField(this);
        field->setToolTip(tip);
        field->setAccessibleName(tip);
        field->setMinimumWidth(72);
        field->setMaximumWidth(96);
        connect(field, &NumberField::chosen, this, [this, member](double value) {
            display_.*member = value;
            emit display_chosen(display_);
        });
        row->addWidget(field);
        return field;
    };
    const auto add_label = [&](const QString& text) {
        auto* label = new QLabel(text, this);
        row->addWidget(label);
        return label;
    };
    name_ = add_label({});
    make_bold(name_);
    name_->setMinimumWidth(1);
    row->addStretch(1);
    channel_ = new QComboBox(this);
    channel_->setToolTip(tr("Channels that are shown"));
    channel_->setAccessibleName(channel_->toolTip());
    row->addWidget(channel_);
    exposure_label_ = add_label(tr("Exposure"));
    exposure_ =
        add_field(tr("Exposure in stops: colours are multiplied by 2 to this power"), &Display::exposure);
    exposure_->setRange(-40, 40);
    range_label_ = add_label(tr("Range"));
    low_ = add_field(tr("Value shown with the lowest colour"), &Display::low);
    high_ = add_field(tr("Value shown with the highest colour"), &Display::high);
    map_ = new QComboBox(this);
    map_->setToolTip(tr("Colour map"));
    map_->setAccessibleName(map_->toolTip());
    for (const auto& name : colour_map_names()) map_->addItem(QString::fromStdString(name));
    row->addWidget(map_);
    automatic_ = new QToolButton(this);
    automatic_->setIcon(icon("range"));
    automatic_->setText(tr("Auto"));
    automatic_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    automatic_->setCheckable(true);
    automatic_->setToolTip(tr("Choose range and colours from the buffer's meaning and values"));
    row->addWidget(automatic_);
    connect(channel_, &QComboBox::activated, this, [this](int index) {
        display_.channel = index - 1;
        emit display_chosen(display_);
    });
    connect(map_, &QComboBox::textActivated, this, [this](const QString& name) {
        display_.colour_map = name.toStdString();
        emit display_chosen(display_);
    });
    connect(automatic_, &QToolButton::clicked, this, &DisplayBar::automatic_chosen);
}

void DisplayBar::set_image(const QString& name, Semantic semantic, int channels) {
    name_->setText(name);
    if (channel_->count() == channels + 1) return;
    channel_->clear();
    channel_->addItem(channels == 1 ? tr("Value") : tr("All channels"));
    for (int c = 0; c < channels; ++c) channel_->addItem(channel_name(semantic, channels, c));
}

void DisplayBar::set_display(const Display& display, bool automatic) {
    display_ = display;
    automatic_->setChecked(automatic);
    exposure_->show_value(display.exposure);
    low_->show_value(display.low);
    high_->show_value(display.high);
    map_->setCurrentText(QString::fromStdString(display.colour_map));
    channel_->setCurrentIndex(std::min(display.channel + 1, channel_->count() - 1));
    update_controls();
}

void DisplayBar::update_controls() {
    const bool colour = display_.mode == Display::Mode::colour;
    const bool ranged = display_.mode == Display::Mode::vector || display_.mode == Display::Mode::scalar;
    exposure_label_->setVisible(colour);
    exposure_->setVisible(colour);
    range_label_->setVisible(ranged);
    low_->setVisible(ranged);
    high_->setVisible(ranged);
    map_->setVisible(display_.mode == Display::Mode::scalar);
    channel_->setVisible(channel_->count() > 2);
}

}  // namespace ir::widgets
