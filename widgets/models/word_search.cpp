#include "widgets/models/word_search.h"

#include <QCoreApplication>
#include <algorithm>

namespace ir::widgets {
namespace {

/// Fits are sums over words; a name that is nearly the query stands before a long one.
constexpr int at_start = 1000, at_word = 800, within = 500, elsewhere = 200, with_gaps = 100;

/// Whether all letters of the word come in this order, without too much between them.
bool has_letters(const QString& text, const QString& word) {
    constexpr qsizetype gaps = 3;  // times the word's length
    for (qsizetype start = text.indexOf(word[0], 0, Qt::CaseInsensitive); start >= 0;
         start = text.indexOf(word[0], start + 1, Qt::CaseInsensitive)) {
        qsizetype at = start;
        for (const QChar letter : word.sliced(1))
            if (at >= 0) at = text.indexOf(letter, at + 1, Qt::CaseInsensitive);
        if (at >= 0 && at - start < gaps * word.size()) return true;
    }
    return false;
}

bool begins_word(const QString& text, qsizetype at) {
    return at > 0 && !text[at - 1].isLetterOrNumber();
}

int fit_of_word(const QString& word, const QString& name, const QStringList& others, Letters letters) {
    int best = 0;
    for (qsizetype at = name.indexOf(word, 0, Qt::CaseInsensitive); at >= 0;
         at = name.indexOf(word, at + 1, Qt::CaseInsensitive))
        best = std::max(best, at == 0 ? at_start : begins_word(name, at) ? at_word : within);
    if (best > 0) return best;
    for (const auto& other : others)
        if (other.contains(word, Qt::CaseInsensitive)) return elsewhere;
    return letters == Letters::some && word.size() > 1 && has_letters(name, word) ? with_gaps : 0;
}

}  // namespace

int fit_of(const QString& query, const QString& name, const QStringList& others, Letters letters) {
    constexpr int max_length = 99;
    int sum = 0;
    const auto words = query.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    for (const auto& word : words) {
        const int fit = fit_of_word(word, name, others, letters);
        if (fit == 0) return 0;
        sum += fit;
    }
    return words.isEmpty() ? 1 : sum + max_length - std::min(max_length, int(name.size()));
}

QString nothing_fits() {
    return QCoreApplication::translate("Search", "Nothing has all of these words.");
}

}  // namespace ir::widgets
