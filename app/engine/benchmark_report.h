#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderers/graph/benchmark.h"

namespace ir::engine {

/// Times are in milliseconds. Cold is the first frame of all, with growing buffers and the driver's
/// compilation; warm is the median of the others, each with everything built anew.
struct BenchmarkPass {
    std::string name, queue;
    double ms = 0;
    bool in_total = false;
    std::uint64_t bytes_made = 0;
};

/// A variant, or a peer, which has only times and `parts`.
struct BenchmarkRow {
    std::string label;
    bool is_peer = false;
    std::string problem;  ///< not empty: one line why there are no numbers
    double cold_wall_ms = 0, cold_ms = 0, warm_ms = 0;
    std::vector<BenchmarkPass> passes;
    std::map<std::string, double> parts;
    std::uint64_t memory_bytes = 0;
    std::map<std::string, double> counters;
    std::map<std::string, double> ratios;      ///< of the warm total to each peer's
    std::vector<std::optional<double>> cells;  ///< by column; empty: the row has no such number
};

struct BenchmarkReport {
    std::string name, doc, method;  ///< of the method the id
    std::string device;
    bool software = false;
    int repeats = 0;
    std::string date;  ///< when it began, UTC
    std::string scene;
    int width = 0, height = 0;
    std::vector<graph::BenchmarkColumn> columns;
    std::vector<BenchmarkRow> rows;  ///< variants in their order, then peers
    std::vector<std::string> notes;  ///< what a reader of the numbers should know, a line each
};

/// The first variant that has numbers: with it the others are compared. Null: none has.
const BenchmarkRow* first_measured(const BenchmarkReport& report);

/// A column as people read it: heading with the unit, one text a row (empty: no number), and the rows that
/// hold the best value, where there are others to be better than.
struct ShownColumn {
    std::string heading;
    std::vector<std::string> cells;
    std::vector<bool> is_best;
};
ShownColumn shown_column(const BenchmarkReport& report, std::size_t column);

/// A line of headings and one a row, aligned; the best of a column is marked with *.
std::string benchmark_table(const BenchmarkReport& report);
/// The table, then all numbers, indented.
std::string benchmark_text(const BenchmarkReport& report);
std::string benchmark_json(const BenchmarkReport& report);
/// The table with numbers in the columns' own units, a heading first.
std::string benchmark_csv(const BenchmarkReport& report);

}  // namespace ir::engine
