#include "renderers/core/words.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace ir {
namespace {

/// How many letters have to be put in, left out, replaced or swapped with their neighbour (optimal string
/// alignment).
std::size_t typing_errors(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

bool is_number(const std::string& text) {
    const char* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto parsed = std::from_chars(begin, end, value);
    return parsed.ec == std::errc{} && parsed.ptr == end;
}

/// What programs for tables take for a formula.
bool is_formula(const std::string& text) {
    return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos &&
           !is_number(text);
}

}  // namespace

std::string listed(const std::vector<std::string>& words) {
    std::string result;
    for (const auto& word : words) result += (result.empty() ? "" : ", ") + word;
    return result;
}

std::string known_are(const std::string& word, const std::vector<std::string>& known) {
    return did_you_mean(word, known) + (known.empty() ? "; there are none" : "; known are " + listed(known));
}

std::string trimmed(const std::string& line) {
    constexpr auto blanks = " \t\r\n";
    const auto begin = line.find_first_not_of(blanks);
    if (begin == std::string::npos) return {};
    return line.substr(begin, line.find_last_not_of(blanks) + 1 - begin);
}

/// Where programs for tables would compute a text that comes from anybody, it gets an apostrophe in front.
std::string csv_field(const std::string& given) {
    const auto text = is_formula(given) ? "'" + given : given;
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
    constexpr std::size_t longest_word = 64, shortest_part = 3;
    if (word.size() > longest_word) return {};
    const std::string* best = nullptr;
    std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const auto& candidate : known) {
        const bool is_part =
            word.size() >= shortest_part && (candidate.starts_with(word) || candidate.ends_with(word));
        const auto errors = is_part ? 1 : typing_errors(word, candidate);
        if (errors >= fewest) continue;
        fewest = errors;
        best = &candidate;
    }
    return best ? " (did you mean '" + *best + "'?)" : std::string();
}

}  // namespace ir
