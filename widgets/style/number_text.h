#pragma once

#include <QString>

namespace ir::widgets {

/// A number for people: so many significant digits and no zeros behind them. Six hide the noise of single
/// precision, so that 44.99999 is 45.
QString number_text(double value, int digits = 6);

/// "1 row", "2 rows".
QString counted(int count, const QString& one, const QString& many);

/// In tenths of a stop, with its sign: "+5.5 EV".
QString exposure_text(double stops);

}  // namespace ir::widgets
