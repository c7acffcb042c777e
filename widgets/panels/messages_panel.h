#pragma once

#include <QWidget>

#include "widgets/models/messages_model.h"

class QAction;
class QComboBox;
class QLineEdit;
class QTableView;
class QToolButton;

namespace ir::widgets {

/// Messages with filters by severity, source and text, going to what they are about, copy and clear.
class MessagesPanel : public QWidget {
    Q_OBJECT
  public:
    explicit MessagesPanel(QWidget* parent = nullptr);
    void add(const Message& message);
    MessagesModel& model() { return *model_; }
    MessagesFilter& filter() { return *filter_; }
    QTableView& view() { return *view_; }

  signals:
    /// Double click or Enter on a message that has a place.
    void go_to(const ir::Message& message);

  public slots:
    void copy();
    void clear();

  private:
    QToolButton* make_severity_button(Severity severity);
    void add_actions();
    void update_counts();
    void update_sources();
    void go(const QModelIndex& at);
    MessagesModel* model_;
    MessagesFilter* filter_;
    QTableView* view_;
    QToolButton* buttons_[3];
    QComboBox* sources_;
    QAction* go_ = nullptr;
};

}  // namespace ir::widgets
