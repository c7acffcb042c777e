#pragma once

#include <QComboBox>

class QFrame;
class QLineEdit;
class QListView;

namespace ir::widgets {

/// A list that is searched by words: all are in an entry's text, data or heading. Entries that cannot be
/// chosen are headings, seen where one below them is. Icons stand in the list only.
class SearchCombo : public QComboBox {
    Q_OBJECT
  public:
    explicit SearchCombo(QWidget* parent);
    void showPopup() override;
    void hidePopup() override;

  protected:
    void initStyleOption(QStyleOptionComboBox* option) const override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void search(const QString& query);
    void choose(const QModelIndex& entry);

    QFrame* popup_;
    QLineEdit* line_;
    QListView* list_;
};

}  // namespace ir::widgets
