#pragma once

#include <QDateTime>
#include <QString>
#include <string>

namespace ir::gui {

inline QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

/// Of files: ISO 8601 in, the clock of the wall out.
inline QString date_text(const std::string& date) {
    const auto when = QDateTime::fromString(text_of(date), Qt::ISODate);
    return when.isValid() ? when.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm")) : text_of(date);
}

}  // namespace ir::gui
