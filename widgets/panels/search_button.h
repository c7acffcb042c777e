#pragma once

#include <QToolButton>

#include "widgets/panels/search_list.h"

namespace ir::widgets {

/// A button that opens a list to search, as others open a menu.
class SearchButton : public QToolButton {
    Q_OBJECT
  public:
    explicit SearchButton(QWidget* parent) : QToolButton(parent), list_(new SearchList(this)) {
        connect(this, &QToolButton::clicked, this, [this] { list_->open_at(*this); });
    }
    SearchList& list() const { return *list_; }

  protected:
    void initStyleOption(QStyleOptionToolButton* option) const override {
        QToolButton::initStyleOption(option);
        option->features |= QStyleOptionToolButton::HasMenu;
    }

  private:
    SearchList* list_;
};

}  // namespace ir::widgets
