#pragma once

#include <QDateTime>
#include <QString>
#include <string>

namespace ir::gui {

inline QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

/// The name of a project's item, or its id where it has none.
template <class Item>
QString name_text(const Item& item) {
    return text_of(item.name.empty() ? item.id : item.name);
}

/// As a menu shows it: "&" would underline the letter behind it.
inline QString in_menu(QString text) {
    return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

/// Of files: ISO 8601 in, the clock of the wall out.
inline QString date_text(const std::string& date) {
    const auto when = QDateTime::fromString(text_of(date), Qt::ISODate);
    return when.isValid() ? when.toLocalTime().toString(QStringLiteral("yyyy-MM-dd HH:mm")) : text_of(date);
}

}  // namespace ir::gui
