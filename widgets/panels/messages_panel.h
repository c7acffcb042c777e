#pragma once

#include <QWidget>

#include "widgets/models/messages_model.h"

class QLineEdit;
class QTableView;
class QToolButton;

namespace ir::widgets {

/// Messages with filters by severity and text, copy and clear.
class MessagesPanel : public QWidget {
    Q_OBJECT
  public:
    explicit MessagesPanel(QWidget* parent = nullptr);
    void add(const Message& message);
    MessagesModel& model() { return *model_; }
    MessagesFilter& filter() { return *filter_; }

  signals:
    /// Double click or Enter on a message that has a place.
    void go_to(const ir::Message& message);

  public slots:
    void copy();
    void clear();

  private:
    QToolButton* make_severity_button(Severity severity, const char* icon_name);
    void update_counts();
    MessagesModel* model_;
    MessagesFilter* filter_;
    QTableView* view_;
    QToolButton* buttons_[3];
};

}  // namespace ir::widgets
