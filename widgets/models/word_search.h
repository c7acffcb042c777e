#pragma once

#include <QString>
#include <QStringList>

namespace ir::widgets {

/// Whether a word may lack letters of what it stands for, as "dpth" of "Depth". Who searches tries without
/// first: with few letters much else fits.
enum class Letters { all, some };

/// How well the words of a query fit, 0: one of them does not. Each has to be in the name or one of the
/// others; best at the beginning of the name or of a word of it, then anywhere in it, then in the others,
/// then in the name with letters left out. Without words all fit alike.
int fit_of(const QString& query, const QString& name, const QStringList& others, Letters letters);
/// What a list says where nothing fits.
QString nothing_fits();

}  // namespace ir::widgets
