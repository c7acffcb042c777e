#include "app/cli/text_table.h"

#include <algorithm>

namespace ir::cli {
namespace {

/// Of letters, not bytes.
std::size_t width_of(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(),
                                     [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

void print_table(std::ostream& out, const std::vector<std::vector<std::string>>& rows,
                 const std::set<std::size_t>& numbers) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (widths.size() <= i) widths.push_back(0);
            widths[i] = std::max(widths[i], width_of(row[i]));
        }
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string space(widths[i] - width_of(row[i]), ' ');
            line += (i == 0 ? "" : "  ") + (numbers.count(i) ? space + row[i] : row[i] + space);
        }
        out << line.substr(0, line.find_last_not_of(' ') + 1) << "\n";
    }
}

}  // namespace ir::cli
