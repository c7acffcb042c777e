#include "widgets/space/selector_row.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>
#include <algorithm>

#include "widgets/parameters/number_field.h"

namespace ir::widgets {

SelectorRow::SelectorRow(QWidget* parent) : QWidget(parent) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(8, 4, 8, 4);
    row->setSpacing(6);
    label_ = new QLabel(this);
    number_ = new QSpinBox(this);
    number_->setKeyboardTracking(false);
    number_->setMinimumWidth(62);
    leave_letters_to_shortcuts(number_);
    count_ = new QLabel(this);
    slider_ = new QSlider(Qt::Horizontal, this);
    slider_->setMinimumWidth(40);
    all_ = new QToolButton(this);
    all_->setText(tr("All"));
    all_->setCheckable(true);
    row->addWidget(label_);
    row->addWidget(number_);
    row->addWidget(count_);
    row->addWidget(slider_, 1);
    row->addWidget(all_);
    connect(number_, &QSpinBox::valueChanged, this, [this](int item) { choose(item); });
    connect(slider_, &QSlider::valueChanged, this, [this](int item) { choose(item); });
    connect(all_, &QToolButton::clicked, this,
            [this](bool on) { choose(on ? SpaceSelector::all : last_single_); });
}

void SelectorRow::choose(int item) {
    if (showing_ || item == selector_.item) return;
    selector_.item = item;
    show_item();
    emit item_chosen(item);
}

void SelectorRow::set_selector(const SpaceSelector& selector) {
    selector_ = selector;
    selector_.count = std::max(1, selector.count);
    const QString label = QString::fromStdString(selector.label);
    const QString doc = QString::fromStdString(selector.doc);
    label_->setText(label);
    count_->setText(tr("of %1").arg(selector_.count));
    setToolTip(doc);
    number_->setAccessibleName(label);
    number_->setToolTip(tr("Number of the item shown, from 0 on"));
    slider_->setAccessibleName(label);
    all_->setToolTip(tr("Show all %1 at once").arg(selector_.count));
    all_->setAccessibleName(all_->toolTip());
    showing_ = true;
    number_->setRange(0, selector_.count - 1);
    slider_->setRange(0, selector_.count - 1);
    slider_->setPageStep(std::max(1, selector_.count / 16));
    showing_ = false;
    show_item();
}

void SelectorRow::show_item() {
    showing_ = true;
    const bool all = selector_.item == SpaceSelector::all;
    if (!all) last_single_ = selector_.item;
    number_->setValue(last_single_);
    slider_->setValue(last_single_);
    all_->setChecked(all);
    showing_ = false;
    // A greyed number says which item a second click on "All" returns to.
    number_->setEnabled(!all);
    slider_->setEnabled(!all);
}

}  // namespace ir::widgets
