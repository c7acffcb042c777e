#include "widgets/panels/card_flow.h"

#include <QWidget>
#include <algorithm>

namespace ir::widgets {

CardFlow::CardFlow(int card_width, QWidget* parent) : QLayout(parent), card_width_(card_width) {
    setContentsMargins(0, 0, 0, 0);
    setSpacing(8);
}

CardFlow::~CardFlow() {
    for (auto* item : items_) delete item;
}

QLayoutItem* CardFlow::itemAt(int index) const {
    return index >= 0 && index < count() ? items_[std::size_t(index)] : nullptr;
}

QLayoutItem* CardFlow::takeAt(int index) {
    auto* item = itemAt(index);
    if (item) items_.erase(items_.begin() + index);
    return item;
}

QSize CardFlow::minimumSize() const {
    QSize size;
    for (const auto* item : items_)
        if (!item->isEmpty()) size = size.expandedTo(item->minimumSize());
    return size;
}

void CardFlow::setGeometry(const QRect& rect) {
    QLayout::setGeometry(rect);
    place(rect, true);
}

int CardFlow::place(const QRect& rect, bool apply) const {
    const int columns = std::max(1, (rect.width() + spacing()) / (card_width_ + spacing()));
    const int width = (rect.width() - (columns - 1) * spacing()) / columns;
    int number = 0, top = rect.top(), row_height = 0;
    for (auto* item : items_) {
        if (item->isEmpty()) continue;
        if (number > 0 && number % columns == 0) {
            top += row_height + spacing();
            row_height = 0;
        }
        const int height =
            item->hasHeightForWidth() ? item->heightForWidth(width) : item->sizeHint().height();
        row_height = std::max(row_height, height);
        if (apply)
            item->setGeometry(
                QRect(rect.left() + number % columns * (width + spacing()), top, width, height));
        ++number;
    }
    return top + row_height - rect.top();
}

}  // namespace ir::widgets
