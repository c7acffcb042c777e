#pragma once

#include <map>
#include <string>

/// What differs between two texts, line by line, in the unified format of `diff -u`.
namespace ir {

/// The hunks that make `after` of `before`, with three lines of context; empty where both are equal. By the
/// shortest script of lines that are added and removed [Myers86]; beyond some thousands of these all that
/// lies between the first and the last difference is replaced.
std::string line_diff(const std::string& before, const std::string& after);

/// `text` changed by hunks. A hunk belongs at the line that it names, moved as the hunks before it were, or
/// else where its lines, context among them, stand once behind those. Throws Error that begins with the hunk,
/// "hunk 2 (@@ -8,6 +8,7 @@)", where its lines are not there, and for what are no hunks.
std::string apply_line_diff(const std::string& text, const std::string& hunks);

struct LineCounts {
    int added = 0, removed = 0;
    std::string text() const;  ///< "+3 −1"
};
/// Throws Error for what are no hunks.
LineCounts count_lines(const std::string& hunks);

/// The hunks of each file in what `git diff` and `diff -ru` write, by the file's name after "+++". Where that
/// line ends as on Windows, the ends of all lines become those of Unix. Throws Error where a file is removed,
/// or stands there twice.
std::map<std::string, std::string> hunks_by_file(const std::string& text);

}  // namespace ir
