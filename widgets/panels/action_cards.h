#pragma once

#include <QAction>
#include <QDialog>
#include <QImage>
#include <vector>

class QLabel;

namespace ir::widgets {

class SampleCard;

/// Actions as cards with pictures. One click does an action and closes the dialog. What cannot be done is
/// grey, and says why.
class ActionCards : public QDialog {
    Q_OBJECT
  public:
    struct Content {
        QAction* action;  ///< its data is what it does
        QImage picture;
    };
    ActionCards(const QString& title, const std::vector<Content>& contents, QWidget* parent = nullptr);

  private:
    void show_reasons();

    std::vector<std::pair<SampleCard*, QAction*>> cards_;
    QLabel* why_not_;
};

}  // namespace ir::widgets
