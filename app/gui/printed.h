#pragma once

#include <QStringList>
#include <algorithm>
#include <vector>

#include "app/engine/live.h"

namespace ir::gui {

/// What shaders printed of an explained pixel; nothing where the result is of another one.
inline std::vector<PrintedValue> printed_of(const engine::LiveResult* result, const Inspection& now) {
    const bool is_same =
        result && now.has_pixel() && result->inspection.x == now.x && result->inspection.y == now.y;
    return is_same ? result->report.printed : std::vector<PrintedValue>();
}

/// In lines, for the picture: the first ones.
inline QString printed_text(const std::vector<PrintedValue>& printed) {
    constexpr std::size_t most = 12;
    QStringList lines;
    for (std::size_t i = 0; i < std::min(printed.size(), most); ++i)
        lines << QString::fromStdString(printed[i].label + " = " + printed[i].text);
    if (printed.size() > most) lines << QObject::tr("… and %1 more").arg(printed.size() - most);
    return lines.join(QLatin1Char('\n'));
}

}  // namespace ir::gui
