#pragma once

#include <QComboBox>
#include <QImage>
#include <functional>

#include "widgets/models/word_search.h"

class QFrame;
class QLabel;
class QLineEdit;
class QListView;

namespace ir::widgets {

/// A list that is searched by words (`fit_of`) of an entry's text, data or heading. Entries that cannot be
/// chosen are headings, seen where one below them is. Icons stand in the list only.
class SearchCombo : public QComboBox {
    Q_OBJECT
  public:
    explicit SearchCombo(QWidget* parent);
    /// Shown with the tooltip of an entry, by its data; asked for when it is pointed at.
    void set_pictures(std::function<QImage(const QString&)> pictures) { pictures_ = std::move(pictures); }
    void showPopup() override;
    void hidePopup() override;

  protected:
    void initStyleOption(QStyleOptionComboBox* option) const override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void search(const QString& query);
    int show_fitting(const QString& query, Letters letters);
    void choose(const QModelIndex& entry);
    void show_tip(const QHelpEvent& event) const;

    QFrame* popup_;
    QLineEdit* line_;
    QLabel* nothing_;
    QListView* list_;
    std::function<QImage(const QString&)> pictures_;
};

}  // namespace ir::widgets
