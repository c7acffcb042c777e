#pragma once

#include <QString>
#include <string>

namespace ir::widgets {

/// For a place where Qt reads tags.
inline QString escaped(const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
}

}  // namespace ir::widgets
