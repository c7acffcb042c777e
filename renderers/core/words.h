#pragma once

#include <functional>
#include <string>
#include <vector>

namespace ir {

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

/// Of each item: `words_of(plots, &Plot::id)`.
template <class Items, class Word>
std::vector<std::string> words_of(const Items& items, Word word) {
    std::vector<std::string> words;
    for (const auto& item : items) words.emplace_back(std::invoke(word, item));
    return words;
}

/// Without blanks around it.
std::string trimmed(const std::string& line);

/// A field of a table [RFC 4180 §2].
std::string csv_field(const std::string& text);

/// How a message ends that says that nobody knows `word`: " (did you mean 'b'?); known are a, b, c". The
/// question is asked where one of them is spelt nearly so, or begins or ends so.
std::string known_are(const std::string& word, const std::vector<std::string>& known);
/// The question alone; empty: none is alike.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace ir
