#pragma once

#include <QIcon>

class QLabel;

namespace ir::widgets {

/// A line drawing in the text's colour, sharp at every size and screen scale. An unknown name is a bug.
QIcon icon(const char* name);
/// On a label, as large as that many logical pixels; it follows the theme.
void show_icon(QLabel* label, const char* name, int size);

}  // namespace ir::widgets
