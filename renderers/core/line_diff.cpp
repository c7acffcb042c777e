#include "renderers/core/line_diff.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

#include "renderers/core/error.h"

namespace ir {
namespace {

using Lines = std::vector<std::string_view>;

constexpr std::size_t context = 3;
/// Added and removed lines that are looked for one by one.
constexpr int most_changes = 2000;
constexpr int most_lines = 10'000'000;
constexpr const char* no_newline = "\\ No newline at end of file\n";

/// With their ends, which the last one may lack.
Lines lines_of(std::string_view text) {
    Lines lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size() - 1) + 1;
        lines.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return lines;
}

/// A line of both texts, of the first alone, or of the second alone.
struct Step {
    char sign;
    std::string_view line;
};

/// The shortest script between two texts [Myers86]; none where it is longer than `most_changes`.
std::optional<std::vector<Step>> shortest(const Lines& a, const Lines& b) {
    const int n = static_cast<int>(a.size()), m = static_cast<int>(b.size());
    // By number of changes d, of each diagonal k = -d … d: how far into `a` it leads.
    std::vector<std::vector<int>> reach;
    const auto begin_of = [&](int d, int k) {
        if (d == 0) return 0;
        const auto& before = reach[std::size_t(d - 1)];
        const auto at = [&](int diagonal) { return before[std::size_t(diagonal + d - 1)]; };
        const bool down = k == -d || (k != d && at(k - 1) < at(k + 1));
        return down ? at(k + 1) : at(k - 1) + 1;
    };
    for (int d = 0;; ++d) {
        if (d > most_changes) return {};
        reach.emplace_back(std::size_t(2 * d + 1), 0);
        for (int k = -d; k <= d; k += 2) {
            int x = begin_of(d, k), y = x - k;
            while (x < n && y < m && a[std::size_t(x)] == b[std::size_t(y)]) ++x, ++y;
            reach.back()[std::size_t(k + d)] = x;
            if (x < n || y < m) continue;
            std::vector<Step> steps;
            for (x = n, y = m; d >= 0; --d) {
                const int begin = begin_of(d, x - y);
                for (; x > begin; --x, --y) steps.push_back({' ', a[std::size_t(x - 1)]});
                if (d == 0) break;
                const auto& before = reach[std::size_t(d - 1)];
                const int diagonal = x - y;
                // The step that leads here keeps x and adds a line of `b`, or takes one of `a`.
                const int above = diagonal + 1 <= d - 1 ? before[std::size_t(diagonal + d)] : -1;
                if (above == x)
                    steps.push_back({'+', b[std::size_t(--y)]});
                else
                    steps.push_back({'-', a[std::size_t(--x)]});
            }
            std::reverse(steps.begin(), steps.end());
            return steps;
        }
    }
}

std::vector<Step> script(Lines a, Lines b) {
    std::vector<Step> head, tail;
    const auto same = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin();
    for (auto i = a.begin(); i != a.begin() + same; ++i) head.push_back({' ', *i});
    a.erase(a.begin(), a.begin() + same);
    b.erase(b.begin(), b.begin() + same);
    for (; !a.empty() && !b.empty() && a.back() == b.back(); a.pop_back(), b.pop_back())
        tail.push_back({' ', a.back()});
    if (const auto middle = shortest(a, b)) {
        head.insert(head.end(), middle->begin(), middle->end());
    } else {
        for (const auto& line : a) head.push_back({'-', line});
        for (const auto& line : b) head.push_back({'+', line});
    }
    head.insert(head.end(), tail.rbegin(), tail.rend());
    return head;
}

struct Hunk {
    std::string name;  ///< "hunk 2 (@@ -8,6 +8,7 @@)"
    int start = 0, old_count = 0, new_count = 0;
    std::vector<std::string> old_lines, new_lines;
    LineCounts counts;
    [[noreturn]] void fail(const std::string& problem) const { throw Error(name + ": " + problem); }
};

/// The range "8,6" or "8" that `text` begins with.
bool take_range(std::string_view& text, int& start, int& count) {
    const auto take = [&](int& number) {
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (problem != std::errc{} || number < 0 || number > most_lines) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        return true;
    };
    count = 1;
    if (!take(start)) return false;
    if (!text.starts_with(',')) return true;
    text.remove_prefix(1);
    return take(count);
}

Hunk begin_hunk(std::string_view header, std::size_t number) {
    Hunk hunk;
    auto text = header;
    int new_start = 0;
    const auto take = [&](std::string_view word) {
        if (!text.starts_with(word)) return false;
        text.remove_prefix(word.size());
        return true;
    };
    const bool is_header = take("@@ -") && take_range(text, hunk.start, hunk.old_count) && take(" +") &&
                           take_range(text, new_start, hunk.new_count) && take(" @@");
    hunk.name = "hunk " + std::to_string(number);
    if (!is_header) hunk.fail("must begin as @@ -8,6 +8,7 @@");
    hunk.name += " (" + std::string(header.substr(0, header.size() - text.size())) + ")";
    return hunk;
}

void add_line(Hunk& hunk, std::string_view line) {
    const char sign = line.front();
    // Editors take blanks away at the ends of lines.
    const std::string text(sign == '\n' ? line : line.substr(1));
    if (sign == ' ' || sign == '\n' || sign == '-') hunk.old_lines.push_back(text);
    if (sign == ' ' || sign == '\n' || sign == '+') hunk.new_lines.push_back(text);
    if (sign == '-') ++hunk.counts.removed;
    if (sign == '+') ++hunk.counts.added;
    if (sign != ' ' && sign != '\n' && sign != '-' && sign != '+')
        hunk.fail("its lines must begin with a blank, + or -");
}

void end_without_newline(std::vector<std::string>& lines) {
    if (!lines.empty() && lines.back().ends_with('\n')) lines.back().pop_back();
}

std::vector<Hunk> hunks_of(const std::string& text) {
    std::vector<Hunk> hunks;
    const auto lines = lines_of(text);
    for (std::size_t i = 0; i < lines.size();) {
        auto header = lines[i++];
        if (header.ends_with('\n')) header.remove_suffix(1);
        auto hunk = begin_hunk(header, hunks.size() + 1);
        const auto is_whole = [&] {
            return hunk.old_lines.size() >= std::size_t(hunk.old_count) &&
                   hunk.new_lines.size() >= std::size_t(hunk.new_count);
        };
        for (; i < lines.size() && (!is_whole() || lines[i].starts_with('\\')); ++i) {
            if (!lines[i].starts_with('\\')) {
                add_line(hunk, lines[i]);
                continue;
            }
            const char last = lines[i - 1].front();
            if (last != '+') end_without_newline(hunk.old_lines);
            if (last != '-') end_without_newline(hunk.new_lines);
        }
        if (hunk.old_lines.size() != std::size_t(hunk.old_count) ||
            hunk.new_lines.size() != std::size_t(hunk.new_count))
            hunk.fail("has not the number of lines that it names");
        hunks.push_back(std::move(hunk));
    }
    return hunks;
}

bool stands_at(const Hunk& hunk, const Lines& lines, std::size_t place) {
    return place + hunk.old_lines.size() <= lines.size() &&
           std::equal(hunk.old_lines.begin(), hunk.old_lines.end(),
                      lines.begin() + static_cast<std::ptrdiff_t>(place));
}

/// Where a hunk belongs, not before `first`.
std::size_t place_of(const Hunk& hunk, const Lines& lines, std::size_t first, std::ptrdiff_t named) {
    if (hunk.old_lines.empty()) {
        if (!lines.empty()) hunk.fail("has no context; make it with some lines around what it adds");
        return 0;
    }
    if (named >= static_cast<std::ptrdiff_t>(first) && stands_at(hunk, lines, std::size_t(named)))
        return std::size_t(named);
    std::optional<std::size_t> found;
    for (auto place = first; place + hunk.old_lines.size() <= lines.size(); ++place) {
        if (!stands_at(hunk, lines, place)) continue;
        if (found) hunk.fail("its lines stand in the file more than once, and not where it says");
        found = place;
    }
    if (!found) hunk.fail("its lines are not in the file");
    return *found;
}

}  // namespace

std::string LineCounts::text() const {
    return "+" + std::to_string(added) + " −" + std::to_string(removed);
}

std::string line_diff(const std::string& before, const std::string& after) {
    const auto steps = script(lines_of(before), lines_of(after));
    const auto is_change = [](const Step& step) { return step.sign != ' '; };
    std::string hunks;
    std::size_t old_line = 0, new_line = 0;  // before `begin`
    for (auto begin = steps.begin();;) {
        const auto change = std::find_if(begin, steps.end(), is_change);
        if (change == steps.end()) return hunks;
        const auto skipped = std::max<std::ptrdiff_t>(0, (change - begin) - std::ptrdiff_t(context));
        begin += skipped;
        old_line += std::size_t(skipped);
        new_line += std::size_t(skipped);
        // To where more lines in a row are equal than both contexts have.
        auto end = change;
        for (auto next = change; next != steps.end() && next - end <= std::ptrdiff_t(2 * context);) {
            end = std::find_if_not(next, steps.end(), is_change);
            next = std::find_if(end, steps.end(), is_change);
        }
        end += std::min<std::ptrdiff_t>(context, std::find_if(end, steps.end(), is_change) - end);
        std::size_t old_count = 0, new_count = 0;
        std::string body;
        for (; begin != end; ++begin) {
            old_count += begin->sign != '+';
            new_count += begin->sign != '-';
            body += begin->sign;
            body += begin->line;
            if (!begin->line.ends_with('\n')) body += std::string("\n") + no_newline;
        }
        const auto range = [](std::size_t line, std::size_t count) {
            return std::to_string(count == 0 ? line : line + 1) + "," + std::to_string(count);
        };
        hunks += "@@ -" + range(old_line, old_count) + " +" + range(new_line, new_count) + " @@\n" + body;
        old_line += old_count;
        new_line += new_count;
    }
}

std::string apply_line_diff(const std::string& text, const std::string& hunks) {
    const auto lines = lines_of(text);
    std::string result;
    std::size_t next = 0;
    std::ptrdiff_t moved = 0;
    for (const auto& hunk : hunks_of(hunks)) {
        const auto named = static_cast<std::ptrdiff_t>(hunk.start) - 1;
        const auto place = place_of(hunk, lines, next, named + moved);
        for (; next < place; ++next) result += lines[next];
        for (const auto& line : hunk.new_lines) result += line;
        next = place + hunk.old_lines.size();
        if (!hunk.old_lines.empty()) moved = static_cast<std::ptrdiff_t>(place) - named;
    }
    for (; next < lines.size(); ++next) result += lines[next];
    return result;
}

LineCounts count_lines(const std::string& hunks) {
    LineCounts sum;
    for (const auto& hunk : hunks_of(hunks)) {
        sum.added += hunk.counts.added;
        sum.removed += hunk.counts.removed;
    }
    return sum;
}

std::map<std::string, std::string> hunks_by_file(const std::string& text) {
    std::map<std::string, std::string> files;
    const auto lines = lines_of(text);
    std::string* hunks = nullptr;
    int old_left = 0, new_left = 0;  // lines of the hunk
    bool has_windows_ends = false;   // a mail or an editor has made them
    const auto add = [&](std::string_view line) {
        *hunks += line;
        if (has_windows_ends && line.ends_with("\r\n")) hunks->erase(hunks->size() - 2, 1);
    };
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const auto& line = lines[i];
        if (old_left > 0 || new_left > 0 || (hunks && line.starts_with('\\'))) {
            old_left -= line.front() != '+' && line.front() != '\\';
            new_left -= line.front() != '-' && line.front() != '\\';
            add(line);
        } else if (line.starts_with("--- ") && i + 1 < lines.size() && lines[i + 1].starts_with("+++ ")) {
            auto name = lines[++i].substr(4);
            name = name.substr(0, name.find_first_of("\t\r\n"));
            if (name == "/dev/null")
                throw Error(std::string(line.substr(4, line.find_first_of("\t\r\n", 4) - 4)) +
                            " is removed; a change may only add, change and remove lines");
            const auto [entry, is_new] = files.try_emplace(std::string(name));
            if (!is_new) throw Error(std::string(name) + " stands there twice");
            hunks = &entry->second;
            has_windows_ends = lines[i].ends_with("\r\n");
        } else if (hunks && line.starts_with("@@ ")) {
            const auto hunk = begin_hunk(line.substr(0, line.find_last_not_of("\r\n") + 1), 1);
            old_left = hunk.old_count;
            new_left = hunk.new_count;
            add(line);
        } else {
            hunks = nullptr;  // "diff -u", "index"
        }
    }
    return files;
}

}  // namespace ir
