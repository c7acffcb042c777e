#pragma once

#include <QWidget>
#include <vector>

class QKeyEvent;
class QListWidget;
class QMenu;
class QToolButton;

namespace ir::widgets {

/// A short list whose rows are added, duplicated, removed and moved: by buttons, or in the list with Ins,
/// Ctrl+D, Del, Alt+Up and Alt+Down. It changes nothing itself.
class OrderedList : public QWidget {
    Q_OBJECT
  public:
    /// `what` is one of its rows: "light". `least`: as many rows stay.
    OrderedList(const char* name, const QString& what, int min, QWidget* parent);
    struct Line {
        QString text, tooltip;
    };
    void show_lines(const std::vector<Line>& lines, int current);
    void set_usable(const QString& why_not);
    /// Shown by the add button; without one, add_wanted is emitted.
    void set_add_menu(QMenu* menu);
    /// Without it there are no buttons and keys that move rows.
    void set_movable(bool movable);
    int current() const;
    QListWidget* list() const { return list_; }

  signals:
    void current_changed(int index);
    void add_wanted();
    void duplicate_wanted(int index);
    void remove_wanted(int index);
    void move_wanted(int from, int to);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    QToolButton* button_for(const QKeyEvent& event) const;
    void update_buttons();
    QListWidget* list_;
    QToolButton *add_, *duplicate_, *up_, *down_, *remove_;
    QString what_, why_not_;
    int min_;
    bool showing_ = false, movable_ = true;
};

}  // namespace ir::widgets
