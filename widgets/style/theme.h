#pragma once

class QApplication;

namespace ir::widgets {

/// Dark and neutral grey, so that nothing around a picture tints it.
void apply_theme(QApplication& application);

}  // namespace ir::widgets
