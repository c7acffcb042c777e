#pragma once

#include <QString>

class QAction;

namespace ir::widgets {

/// Without the marks of the letters that menus underline.
QString plain_text(QString text);
/// "View", "File › Recent"; "Other" for actions that no menu holds.
QString menu_title(const QAction& action);
/// "Ctrl+T or F5"
QString keys_of(const QAction& action);

}  // namespace ir::widgets
