#include "widgets/views/search_combo.h"

#include <QStandardItemModel>

namespace ir::widgets {

SearchCombo::SearchCombo(QWidget* parent) : QComboBox(parent), list_(new SearchList(this)) {
    setModel(list_->model());
    connect(list_, &SearchList::chosen, this, [this](const QModelIndex& chosen) {
        const int row = chosen.row();
        setCurrentIndex(row);
        emit activated(row);
        emit textActivated(itemText(row));
    });
}

void SearchCombo::showPopup() {
    list_->open_at(*this, currentIndex());
}

void SearchCombo::hidePopup() {
    list_->hide();
    QComboBox::hidePopup();
}

/// Names keep the room.
void SearchCombo::initStyleOption(QStyleOptionComboBox* option) const {
    QComboBox::initStyleOption(option);
    option->currentIcon = {};
}

}  // namespace ir::widgets
