#include "widgets/style/number_text.h"

#include <cmath>

namespace ir::widgets {

QString number_text(double value, int digits) {
    if (std::isnan(value)) return QStringLiteral("NaN");
    if (std::isinf(value)) return value > 0 ? QStringLiteral("+Inf") : QStringLiteral("-Inf");
    return QString::number(value == 0 ? 0.0 : value, 'g', digits);
}

QString counted(int count, const QString& one, const QString& many) {
    return QString::number(count) + QLatin1Char(' ') + (count == 1 ? one : many);
}

QString exposure_text(double stops) {
    const double tenths = std::round(10 * stops) / 10;
    return QStringLiteral("%1%2 EV").arg(QLatin1String(tenths < 0 ? "" : "+"), number_text(tenths));
}

}  // namespace ir::widgets
