#include "widgets/space/filter_row.h"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "widgets/parameters/number_field.h"
#include "widgets/space/range_slider.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QToolButton* make_button(QWidget* parent, const char* icon_name, const QString& tip) {
    auto* button = new QToolButton(parent);
    button->setIcon(icon(icon_name));
    button->setAutoRaise(true);
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    return button;
}

QToolButton* make_step(QWidget* parent, Qt::ArrowType arrow, const QString& tip) {
    auto* button = new QToolButton(parent);
    button->setArrowType(arrow);
    button->setAutoRaise(true);
    button->setAutoRepeat(true);
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    return button;
}

}  // namespace

FilterRow::FilterRow(const Field& field, QWidget* parent) : QWidget(parent), field_(field) {
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 2, 0, 4);
    grid->setHorizontalSpacing(4);
    grid->setVerticalSpacing(2);
    const QString name = QString::fromStdString(field.name);
    const auto make_field = [&](const QString& tip) {
        auto* number = new NumberField(this);
        number->set_whole(field.type != FieldType::f32);
        number->setFixedWidth(68);
        number->setButtonSymbols(QAbstractSpinBox::NoButtons);
        number->setToolTip(tip);
        number->setAccessibleName(tip);
        return number;
    };
    low_ = make_field(tr("Least %1 that is shown").arg(name));
    high_ = make_field(tr("Greatest %1 that is shown").arg(name));
    slider_ = new RangeSlider(this);
    slider_->setAccessibleName(tr("%1 shown").arg(name));
    back_ = make_step(this, Qt::LeftArrow, tr("One step down"));
    forward_ = make_step(this, Qt::RightArrow, tr("One step up"));
    everything_ = make_button(this, "range", tr("Show every %1").arg(name));
    remove_ = make_button(this, "cancel", tr("Filter by %1 no longer").arg(name));
    QSizePolicy keeps_place = remove_->sizePolicy();
    keeps_place.setRetainSizeWhenHidden(true);  // rows with and without it line up
    remove_->setSizePolicy(keeps_place);
    grid->addWidget(new QLabel(name, this), 0, 0, 1, 2);
    grid->addWidget(low_, 0, 2);
    grid->addWidget(new QLabel(QStringLiteral("–"), this), 0, 3);
    grid->addWidget(high_, 0, 4);
    grid->addWidget(everything_, 0, 5);
    grid->addWidget(remove_, 0, 6);
    grid->addWidget(back_, 1, 0);
    grid->addWidget(slider_, 1, 1, 1, 4);
    grid->addWidget(forward_, 1, 5);
    grid->setColumnStretch(1, 1);
    connect(slider_, &RangeSlider::range_chosen, this, &FilterRow::choose);
    connect(low_, &NumberField::chosen, this,
            [this](double value) { choose(value, std::max(value, high_->value())); });
    connect(high_, &NumberField::chosen, this,
            [this](double value) { choose(std::min(value, low_->value()), value); });
    connect(back_, &QToolButton::clicked, this, [this] { slider_->step(-1); });
    connect(forward_, &QToolButton::clicked, this, [this] { slider_->step(1); });
    connect(everything_, &QToolButton::clicked, this, [this] { emit filter_chosen(std::nullopt); });
    connect(remove_, &QToolButton::clicked, this, &FilterRow::remove_chosen);
}

void FilterRow::set_removable(bool removable) {
    remove_->setVisible(removable);
}

void FilterRow::choose(double low, double high) {
    low_->show_value(low);
    high_->show_value(high);
    const bool everything = limits_ && low <= limits_->low && high >= limits_->high;
    everything_->setEnabled(!everything);
    if (everything) return emit filter_chosen(std::nullopt);
    emit filter_chosen(SpaceFilter{field_.name, low, high});
}

void FilterRow::show_filter(const std::optional<FieldRange>& limits,
                            const std::optional<SpaceFilter>& filter) {
    limits_ = limits;
    const FieldRange ends = limits.value_or(FieldRange{0, 1});
    const FieldRange shown = filter ? FieldRange{filter->low, filter->high} : ends;
    // A filter may reach further than the elements: the track holds both.
    slider_->set_limits(std::min(ends.low, shown.low), std::max(ends.high, shown.high),
                        field_.type != FieldType::f32);
    slider_->set_range(shown.low, shown.high);
    low_->show_value(shown.low);
    high_->show_value(shown.high);
    for (QWidget* part :
         {static_cast<QWidget*>(slider_), static_cast<QWidget*>(back_), static_cast<QWidget*>(forward_)})
        part->setEnabled(limits.has_value());
    everything_->setEnabled(filter.has_value());
}

}  // namespace ir::widgets
