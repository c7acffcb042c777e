#include "widgets/inspect/display_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "widgets/inspect/colour_map_box.h"
#include "widgets/inspect/histogram_view.h"
#include "widgets/parameters/number_field.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

constexpr int slider_steps = 10;  ///< a stop
constexpr int slider_stops = 10;  ///< to either side; the number field goes further

QLabel* add_label(QGridLayout* grid, const QString& text, const QString& tip, QWidget* buddy) {
    auto* label = new QLabel(text);
    label->setToolTip(tip);
    label->setBuddy(buddy);
    grid->addWidget(label, grid->rowCount(), 0);
    return label;
}

}  // namespace

DisplayPanel::DisplayPanel(QWidget* parent) : QWidget(parent) {
    auto* content = new QWidget;
    auto* page = new QVBoxLayout(content);
    page->setContentsMargins(8, 6, 8, 8);
    page->setSpacing(4);
    make_histogram(page);
    controls_ = new QWidget;
    auto* grid = new QGridLayout(controls_);
    grid->setContentsMargins(0, 6, 0, 0);
    grid->setHorizontalSpacing(8);
    grid->setVerticalSpacing(5);
    grid->setColumnStretch(1, 1);
    page->addWidget(controls_);
    make_colours(grid);
    make_range(grid);
    make_marks(grid);
    reset_ = new QPushButton(icon("reset"), tr("Automatic colours and range"));
    reset_->setObjectName(QStringLiteral("automatic"));
    connect(reset_, &QPushButton::clicked, this, &DisplayPanel::automatic_chosen);
    page->addWidget(reset_);
    page->addStretch(1);

    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(content);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    set_image({}, Semantic::generic, {}, nullptr);
}

void DisplayPanel::make_histogram(QBoxLayout* page) {
    title_ = new QLabel(this);
    title_->setMinimumWidth(1);
    title_->setWordWrap(true);
    page->addWidget(title_);
    histogram_ = new HistogramView(this);
    page->addWidget(histogram_);
    counts_ = new QLabel(this);
    counts_->setObjectName(QStringLiteral("counts"));
    counts_->setWordWrap(true);
    counts_->setForegroundRole(QPalette::PlaceholderText);
    counts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    logarithmic_ = new QToolButton(this);
    logarithmic_->setObjectName(QStringLiteral("logarithmic"));
    logarithmic_->setText(tr("Log"));
    logarithmic_->setToolTip(tr("Logarithmic heights, so that rare values are seen beside common ones"));
    logarithmic_->setCheckable(true);
    logarithmic_->setChecked(histogram_->logarithmic());
    auto* row = new QHBoxLayout;
    row->addWidget(counts_, 1);
    row->addWidget(logarithmic_, 0, Qt::AlignTop);
    page->addLayout(row);
    connect(logarithmic_, &QToolButton::toggled, histogram_, &HistogramView::set_logarithmic);
    connect(histogram_, &HistogramView::counted, this, &DisplayPanel::update_counts);
    connect(histogram_, &HistogramView::range_dragged, this, &DisplayPanel::fit);
}

QComboBox* DisplayPanel::add_choice(QGridLayout* grid, const char* name, const QString& label,
                                    const QString& tip, std::function<void(Display&, int)> take) {
    auto* box = new QComboBox;
    box->setObjectName(QLatin1String(name));
    box->setToolTip(tip);
    box->setAccessibleName(label);
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    auto* row_label = add_label(grid, label, tip, box);
    grid->addWidget(box, grid->rowCount() - 1, 1);
    connect(box, &QComboBox::activated, this, [this, take = std::move(take)](int index) {
        Display display = display_;
        take(display, index);
        choose(display);
    });
    if (box->objectName() == QStringLiteral("tone-map")) colour_rows_ << row_label << box;
    return box;
}

NumberField* DisplayPanel::add_number(const char* name, const QString& tip, double Display::*member) {
    auto* field = new NumberField;
    field->setObjectName(QLatin1String(name));
    field->setToolTip(tip);
    field->setAccessibleName(tip);
    field->setMinimumWidth(72);
    connect(field, &NumberField::chosen, this, [this, member](double value) {
        Display display = display_;
        display.*member = value;
        choose(display);
    });
    return field;
}

void DisplayPanel::make_colours(QGridLayout* grid) {
    mode_ = add_choice(grid, "mode", tr("Mode"), tr("How numbers become colours"),
                       [](Display& display, int index) { display.mode = Display::Mode(index); });
    mode_->addItems({tr("Colour: light"), tr("Vector: red, green, blue"), tr("Scalar: a colour map"),
                     tr("Ids: a colour a number")});
    mode_->setItemData(0, tr("Linear light: exposure, tone map, then the sRGB transfer function"),
                       Qt::ToolTipRole);
    channel_ = add_choice(grid, "channel", tr("Channel"), tr("Channels that are shown"),
                          [](Display& display, int index) { display.channel = index - 1; });

    exposure_ = add_number("exposure", tr("Exposure in stops: light is multiplied by 2 to this power"),
                           &Display::exposure);
    exposure_->setRange(-40, 40);
    exposure_slider_ = new QSlider(Qt::Horizontal);
    exposure_slider_->setObjectName(QStringLiteral("exposure-slider"));
    exposure_slider_->setRange(-slider_stops * slider_steps, slider_stops * slider_steps);
    exposure_slider_->setPageStep(slider_steps);
    exposure_slider_->setMinimumWidth(60);
    exposure_slider_->setAccessibleName(tr("Exposure"));
    connect(exposure_slider_, &QSlider::valueChanged, this, [this](int position) {
        Display display = display_;
        display.exposure = position / double(slider_steps);
        choose(display);
    });
    fit_exposure_ = new QPushButton(tr("Fit"));
    fit_exposure_->setObjectName(QStringLiteral("fit-exposure"));
    auto* label = add_label(grid, tr("Exposure"), exposure_->toolTip(), exposure_);
    auto* row = new QHBoxLayout;
    row->setSpacing(6);
    row->addWidget(exposure_slider_, 1);
    row->addWidget(exposure_);
    row->addWidget(fit_exposure_);
    grid->addLayout(row, grid->rowCount() - 1, 1);
    fit_exposure_->setMaximumWidth(44);
    connect(fit_exposure_, &QPushButton::clicked, this, &DisplayPanel::fit_exposure);
    colour_rows_ << label << exposure_slider_ << exposure_ << fit_exposure_;

    tone_map_ = add_choice(grid, "tone-map", tr("Tone map"), tr("From light to what a screen can show"),
                           [](Display& display, int index) { display.tone_map = Display::ToneMap(index); });
    tone_map_->addItems({tr("None: clipped at 1"), tr("Reinhard"), tr("Filmic")});
}

void DisplayPanel::make_range(QGridLayout* grid) {
    map_ = new ColourMapBox;
    map_->setObjectName(QStringLiteral("colour-map"));
    map_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    map_->setMinimumContentsLength(6);
    map_rows_ << add_label(grid, tr("Colour map"), map_->toolTip(), map_) << map_;
    grid->addWidget(map_, grid->rowCount() - 1, 1);
    connect(map_, &ColourMapBox::chosen, this, [this](const QString& name) {
        Display display = display_;
        display.colour_map = name.toStdString();
        display.categories.clear();
        choose(display);
    });
    low_ = add_number("low", tr("Value shown with the lowest colour"), &Display::low);
    high_ = add_number("high", tr("Value shown with the highest colour"), &Display::high);
    auto* range = new QHBoxLayout;
    range->setSpacing(6);
    auto* dash = new QLabel(QStringLiteral("–"));
    range->addWidget(low_, 1);
    range->addWidget(dash);
    range->addWidget(high_, 1);
    range_rows_ << add_label(grid, tr("Range"), tr("Values between which colours change"), low_) << low_
                << high_ << dash;
    grid->addLayout(range, grid->rowCount() - 1, 1);

    const auto button = [](const char* name, const QString& text) {
        auto* result = new QPushButton(text);
        result->setObjectName(QLatin1String(name));
        result->setMinimumWidth(40);
        return result;
    };
    fit_all_ = button("fit-all", tr("Min–max"));
    fit_most_ = button("fit-most", tr("1–99 %"));
    symmetric_ = button("symmetric", tr("±"));
    symmetric_->setMaximumWidth(48);
    symmetric_->setToolTip(tr("Make the range symmetric around zero, for signed quantities"));
    symmetric_->setAccessibleName(symmetric_->toolTip());
    auto* fits = new QHBoxLayout;
    fits->setSpacing(6);
    for (auto* one : {fit_all_, fit_most_, symmetric_}) fits->addWidget(one, one == symmetric_ ? 0 : 1);
    range_rows_ << add_label(grid, tr("Fit"), tr("Take the range from the values"), fit_all_) << fit_all_
                << fit_most_ << symmetric_;
    grid->addLayout(fits, grid->rowCount() - 1, 1);
    connect(fit_all_, &QPushButton::clicked, this, [this] {
        if (const auto* counts = histogram_->current()) fit(counts->min, counts->max);
    });
    connect(fit_most_, &QPushButton::clicked, this, [this] {
        if (const auto* counts = histogram_->current()) fit(counts->percentile_1, counts->percentile_99);
    });
    connect(symmetric_, &QPushButton::clicked, this, [this] {
        const double largest = std::max(std::abs(display_.low), std::abs(display_.high));
        fit(-largest, largest);
    });
}

QCheckBox* DisplayPanel::add_switch(QGridLayout* grid, const char* name, const QString& label,
                                    const QString& tip, bool Display::*member) {
    auto* box = new QCheckBox(label);
    box->setObjectName(QLatin1String(name));
    box->setToolTip(tip);
    grid->addWidget(box, grid->rowCount(), 0, 1, 2);
    connect(box, &QCheckBox::clicked, this, [this, member](bool on) {
        Display display = display_;
        display.*member = on;
        choose(display);
    });
    return box;
}

void DisplayPanel::make_marks(QGridLayout* grid) {
    marks_ = add_switch(grid, "marks", tr("Mark NaN and Inf"), tr("NaN magenta, +Inf yellow, −Inf cyan"),
                        &Display::mark_bad);
    negative_ = add_switch(grid, "negative", tr("Mark negative values"),
                           tr("Blue, for quantities that cannot be negative"), &Display::negative_is_bad);
    zebra_ = add_switch(grid, "zebra", tr("Stripes beyond the range"),
                        tr("Blue stripes where values are below the range, red ones where they are above"),
                        &Display::zebra);
    hide_invalid_ = add_switch(grid, "hide-invalid", tr("Hide pixels that do not count"),
                               tr("A grey chequer where the method says that its result is not valid"),
                               &Display::hide_invalid);
}

}  // namespace ir::widgets
