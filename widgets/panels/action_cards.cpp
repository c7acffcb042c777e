#include "widgets/panels/action_cards.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>

#include "widgets/panels/action_text.h"
#include "widgets/panels/cards.h"

namespace ir::widgets {

ActionCards::ActionCards(const QString& title, const std::vector<Content>& contents, QWidget* parent)
    : QDialog(parent), why_not_(new QLabel) {
    setWindowTitle(title);
    auto* shelf = new QWidget;
    auto* flow = new CardFlow(SampleCard::usual_width, shelf);
    for (const auto& [action, picture] : contents) {
        auto* card = new SampleCard(
            {plain_text(action->text()), action->data().toString(), keys_of(*action), picture});
        flow->addWidget(card);
        connect(card, &SampleCard::clicked, this, [this, action = action] {
            accept();
            action->trigger();
        });
        connect(action, &QAction::changed, this, &ActionCards::show_reasons);
        cards_.emplace_back(card, action);
    }
    auto* scroll = new QScrollArea;
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(shelf);
    why_not_->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(scroll, 1);
    layout->addWidget(why_not_);
    layout->addWidget(buttons);
    show_reasons();
    // Three cards beside each other, and two rows of them.
    const int side = scroll->verticalScrollBar()->sizeHint().width();
    const int across = 3 * SampleCard::usual_width + 2 * flow->spacing() + side;
    resize(across + 2 * layout->contentsMargins().left(),
           flow->heightForWidth(across) + buttons->sizeHint().height() + 64);
}

void ActionCards::show_reasons() {
    bool any = false;
    for (const auto& [card, action] : cards_) {
        card->setEnabled(action->isEnabled());
        card->setToolTip(action->toolTip());
        any |= action->isEnabled();
    }
    why_not_->setText(any || cards_.empty() ? QString() : cards_.front().second->toolTip().section('\n', -1));
    why_not_->setVisible(!why_not_->text().isEmpty());
}

}  // namespace ir::widgets
