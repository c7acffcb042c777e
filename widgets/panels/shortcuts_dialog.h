#pragma once

#include <QAction>
#include <QDialog>
#include <QList>

namespace ir::widgets {

/// Every action of a window with its keys, searchable, made from the actions themselves.
class ShortcutsDialog : public QDialog {
    Q_OBJECT
  public:
    /// `gestures` are lines (what, how) for what is done with mouse and held keys.
    ShortcutsDialog(const QList<QAction*>& actions, const QList<QPair<QString, QString>>& gestures,
                    QWidget* parent = nullptr);
};

}  // namespace ir::widgets
