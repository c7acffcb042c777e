#pragma once

#include <QAction>
#include <QDialog>
#include <QList>

class QTreeWidget;
class QTreeWidgetItem;

namespace ir::widgets {

/// Every action of a window with its keys, grouped by menu, searchable, made from the actions themselves.
class ShortcutsDialog : public QDialog {
    Q_OBJECT
  public:
    /// `gestures` are lines (what, how) for what is done with mouse and held keys.
    ShortcutsDialog(const QList<QAction*>& actions, const QList<QPair<QString, QString>>& gestures,
                    QWidget* parent = nullptr);

  private:
    QTreeWidgetItem* group(const QString& title);
    void add_line(const QString& group_title, const QString& what, const QString& how);
    void search(const QString& text);
    QTreeWidget* tree_;
};

}  // namespace ir::widgets
