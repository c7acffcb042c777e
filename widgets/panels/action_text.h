#pragma once

#include <QList>
#include <QString>

class QAction;
class QToolButton;
class QWidget;

namespace ir::widgets {

/// Without the marks of the letters that menus underline.
QString plain_text(QString text);
/// "View", "File › Recent"; "Other" for actions that no menu holds.
QString menu_title(const QAction& action);
/// "Ctrl+T or F5"
QString keys_of(const QAction& action);

/// A button in a panel's row does something that has a name.
void mark_as_action(QToolButton& button);
/// Those in a panel that are there now, in their order.
QList<QToolButton*> actions_in(const QWidget& panel);

}  // namespace ir::widgets
