#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/engine/benchmark_report.h"
#include "app/engine/number_text.h"

namespace ir::engine {
namespace {

using Best = graph::BenchmarkColumn::Best;

std::vector<double> numbers_of(const BenchmarkReport& report, std::size_t column) {
    std::vector<double> numbers;
    for (const auto& row : report.rows)
        if (row.cells[column] && std::isfinite(*row.cells[column])) numbers.push_back(*row.cells[column]);
    return numbers;
}

struct Scale {
    double factor = 1;
    std::string unit;
};

/// One unit for all of a column, by its largest number.
Scale scale_of(const std::string& unit, const std::vector<double>& numbers) {
    if (unit != "B") return {1, unit};
    double largest = 0;
    for (const double number : numbers) largest = std::max(largest, std::abs(number));
    if (largest >= 1e9) return {1e-9, "GB"};
    if (largest >= 1e6) return {1e-6, "MB"};
    if (largest >= 1e3) return {1e-3, "kB"};
    return {1, "B"};
}

/// Of the integer part; 0 for numbers below 1.
int digits(double number) {
    return number < 1 ? 0 : static_cast<int>(std::floor(std::log10(number))) + 1;
}

/// Decimals that give the smallest number four digits and the largest at most six; -1: they are too far
/// apart for a common number of decimals.
int decimals_of(const std::vector<double>& numbers, double factor) {
    double smallest = INFINITY, largest = 0;
    bool integral = true;
    for (const double number : numbers) {
        const double size = std::abs(number * factor);
        integral = integral && size == std::floor(size);
        largest = std::max(largest, size);
        if (size > 0) smallest = std::min(smallest, size);
    }
    if (integral || largest == 0) return 0;
    if (smallest < 1e-3 || smallest * 1e5 < largest) return -1;
    const int wanted =
        smallest >= 1 ? 4 - digits(smallest) : 3 - static_cast<int>(std::floor(std::log10(smallest)));
    return std::clamp(wanted, 0, std::max(0, 6 - digits(largest)));
}

std::string with_thousands(std::string text) {
    const auto point = std::min(text.find('.'), text.size());
    const std::size_t first = text[0] == '-' ? 1 : 0;
    for (std::size_t at = point; at > first + 3; at -= 3) text.insert(at - 3, ",");
    return text;
}

std::string number_text(double number, int decimals) {
    if (!std::isfinite(number)) return std::isnan(number) ? "nan" : number > 0 ? "inf" : "-inf";
    char text[400];
    if (decimals < 0 || std::abs(number) >= 1e15) {
        std::snprintf(text, sizeof text, "%.3g", number);
        return text;
    }
    std::snprintf(text, sizeof text, "%.*f", decimals, number);
    return with_thousands(text);
}

std::vector<bool> best_of(const BenchmarkReport& report, std::size_t column,
                          const std::vector<double>& numbers) {
    std::vector<bool> is_best(report.rows.size(), false);
    const auto best = report.columns[column].best;
    if (best == Best::none || numbers.empty()) return is_best;
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    if (*low == *high) return is_best;
    const double value = best == Best::lowest ? *low : *high;
    for (std::size_t row = 0; row < report.rows.size(); ++row)
        is_best[row] = report.rows[row].cells[column] == value;
    return is_best;
}

std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string space(width - std::min(width, width_of(text)), ' ');
    return right ? space + text : text + space;
}

std::string label_of(const BenchmarkRow& row) {
    return row.is_peer ? row.label + " (peer)" : row.label;
}

std::string heading_of(const std::string& label, const std::string& unit) {
    return unit.empty() ? label : label + " [" + unit + "]";
}

}  // namespace

const BenchmarkRow* first_measured(const BenchmarkReport& report) {
    for (const auto& row : report.rows)
        if (!row.is_peer && row.problem.empty()) return &row;
    return nullptr;
}

ShownColumn shown_column(const BenchmarkReport& report, std::size_t column) {
    const auto numbers = numbers_of(report, column);
    const auto scale = scale_of(report.columns[column].unit, numbers);
    const int decimals = decimals_of(numbers, scale.factor);
    ShownColumn shown{
        heading_of(report.columns[column].label, scale.unit), {}, best_of(report, column, numbers)};
    for (const auto& row : report.rows)
        shown.cells.push_back(row.cells[column] ? number_text(*row.cells[column] * scale.factor, decimals)
                                                : std::string());
    return shown;
}

std::string benchmark_table(const BenchmarkReport& report) {
    std::size_t label_width = width_of("Variant");
    for (const auto& row : report.rows) label_width = std::max(label_width, width_of(label_of(row)));
    std::vector<std::string> lines{padded("Variant", label_width, false)};
    for (const auto& row : report.rows) lines.push_back(padded(label_of(row), label_width, false));
    for (std::size_t column = 0; column < report.columns.size(); ++column) {
        auto shown = shown_column(report, column);
        std::size_t width = width_of(shown.heading);
        for (std::size_t row = 0; row < shown.cells.size(); ++row) {
            if (shown.cells[row].empty()) shown.cells[row] = "-";
            width = std::max(width, width_of(shown.cells[row]));
        }
        // The mark stands behind the number, so that digits stay below each other.
        lines[0] += "  " + padded(shown.heading, width, true) + " ";
        for (std::size_t row = 0; row < shown.cells.size(); ++row)
            if (report.rows[row].problem.empty())
                lines[row + 1] +=
                    "  " + padded(shown.cells[row], width, true) + (shown.is_best[row] ? "*" : " ");
    }
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0 && !report.rows[i - 1].problem.empty()) lines[i] += "  " + report.rows[i - 1].problem;
        text += lines[i].substr(0, lines[i].find_last_not_of(' ') + 1) + "\n";
    }
    for (const auto& note : report.notes) text += "note: " + note + "\n";
    return text;
}

std::string benchmark_csv(const BenchmarkReport& report) {
    std::string text = "variant";
    for (const auto& column : report.columns) text += "," + csv_field(heading_of(column.label, column.unit));
    text += ",problem\r\n";
    for (const auto& row : report.rows) {
        text += csv_field(row.label);
        for (const auto& cell : row.cells) text += "," + (cell ? csv_number(*cell) : std::string());
        text += "," + csv_field(row.problem) + "\r\n";
    }
    return text;
}

}  // namespace ir::engine
