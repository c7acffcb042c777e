#pragma once

#include <QString>
#include <string>

namespace ir::gui {

inline QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

}  // namespace ir::gui
