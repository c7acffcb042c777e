#include "widgets/compare/stage_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QStandardItemModel>
#include <QToolButton>

#include "widgets/style/icons.h"

namespace ir::widgets {

StagePair with_chosen(StagePair pair, int picture) {
    if (picture == pair.a) return {pair.b >= 0 ? pair.b : StagePair::none, StagePair::none};
    if (picture == pair.b) return {pair.a, StagePair::none};
    if (pair.a == StagePair::none) return {picture, pair.b};
    if (pair.b == StagePair::none) return {pair.a, picture};
    return {pair.b >= 0 ? pair.b : pair.a, picture};
}

StagePair with_swapped(StagePair pair) {
    for (int* end : {&pair.a, &pair.b})
        if (*end == 0 || *end == 1) *end = 1 - *end;
    return pair;
}

StageBar::StageBar(QWidget* parent) : QWidget(parent) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(6, 2, 6, 3);
    row->setSpacing(6);
    row->addWidget(new QLabel(tr("Compare"), this));
    a_ = make_list(QStringLiteral("stage-a"),
                   tr("All, or a stage of the row (1 … 9, or a click on its name)"));
    row->addWidget(a_);
    row->addWidget(new QLabel(tr("with"), this));
    b_ = make_list(QStringLiteral("stage-b"), tr("Their neighbours, another stage, or their references"));
    row->addWidget(b_);
    clear_ = new QToolButton(this);
    clear_->setObjectName(QStringLiteral("stage-clear"));
    clear_->setIcon(icon("cancel"));
    clear_->setAutoRaise(true);
    clear_->setToolTip(tr("Compare neighbours alone (0)"));
    clear_->setAccessibleName(clear_->toolTip());
    connect(clear_, &QToolButton::clicked, this, [this] { emit chosen({}); });
    row->addWidget(clear_);
    number_ = new QLabel(this);
    number_->setObjectName(QStringLiteral("stage-number"));
    number_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    number_->setMinimumWidth(1);
    row->addWidget(number_, 1);
}

QComboBox* StageBar::make_list(const QString& name, const QString& tip) {
    auto* list = new QComboBox(this);
    list->setObjectName(name);
    list->setToolTip(tip);
    list->setAccessibleName(tip);
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(10);
    list->setMinimumWidth(48);  // four views fit a small screen
    connect(list, &QComboBox::activated, this, [this] {
        emit chosen({a_->currentData().toInt(), b_->currentData().toInt()});
    });
    return list;
}

void StageBar::set_stages(const QStringList& labels, bool has_reference) {
    if (filled_ && labels == labels_ && has_reference == has_reference_) return;
    filled_ = true;
    labels_ = labels;
    has_reference_ = has_reference;
    for (auto* list : {a_, b_}) {
        list->clear();
        list->addItem(list == a_ ? tr("All") : tr("neighbours"), StagePair::none);
        for (int i = 0; i < labels.size(); ++i) list->addItem(labels[i], i);
    }
    b_->addItem(tr("Reference"), StagePair::reference);
    const int last = b_->count() - 1;
    b_->setItemData(last,
                    has_reference
                        ? tr("The reference of the picture's experiment, each picture's own")
                        : tr("No picture has a reference: Match reference (Ctrl+M) gives its experiment one"),
                    Qt::ToolTipRole);
    if (auto* model = qobject_cast<QStandardItemModel*>(b_->model()))
        model->item(last)->setEnabled(has_reference);
    show_pair();
}

void StageBar::set_pair(StagePair pair) {
    pair_ = pair;
    show_pair();
}

void StageBar::show_pair() {
    a_->setCurrentIndex(std::max(0, a_->findData(pair_.a)));
    b_->setCurrentIndex(std::max(0, b_->findData(pair_.b)));
    clear_->setEnabled(pair_ != StagePair());
}

void StageBar::set_number(const QString& number) {
    number_->setText(number);
}

}  // namespace ir::widgets
