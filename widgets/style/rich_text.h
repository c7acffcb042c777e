#pragma once

#include <QImage>
#include <QString>
#include <string>

namespace ir::widgets {

/// For a place where Qt reads tags.
inline QString escaped(const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
}

/// The picture and an end of line; empty where there is none.
QString picture_text(const QImage& picture);

}  // namespace ir::widgets
