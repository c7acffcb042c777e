#pragma once

#include <QComboBox>

#include "widgets/panels/search_list.h"

namespace ir::widgets {

/// A combo box whose list is searched. Icons stand in the list only.
class SearchCombo : public QComboBox {
    Q_OBJECT
  public:
    explicit SearchCombo(QWidget* parent);
    SearchList& list() const { return *list_; }
    void showPopup() override;
    void hidePopup() override;

  protected:
    void initStyleOption(QStyleOptionComboBox* option) const override;

  private:
    SearchList* list_;
};

}  // namespace ir::widgets
