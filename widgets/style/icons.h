#pragma once

#include <QIcon>

namespace ir::widgets {

/// A line drawing in the text's colour, sharp at every size and screen scale. An unknown name is a bug.
QIcon icon(const char* name);

}  // namespace ir::widgets
