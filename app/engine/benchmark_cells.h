#pragma once

#include "app/engine/benchmark_report.h"
#include "app/engine/benchmarks.h"
#include "app/engine/execution.h"

namespace ir::engine {

/// A main result with which others are compared.
struct BenchmarkPicture {
    Image image, valid;
};
BenchmarkPicture picture_of(const Execution& execution);

/// Fills a variant's cells but for ratios, after its last warm frame, of which `frame` is the report. `first`
/// is the first variant's picture (null: this is the first). May compute what columns look at beyond that
/// frame. A cell that cannot be had stays empty; where there was an error a note says which.
void fill_cells(BenchmarkReport& report, BenchmarkRow& row, const FrameReport& frame, Execution& execution,
                const BenchmarkPicture* first, const graph::FrameOptions& options);

/// A column whose cells the benchmark fills itself.
graph::BenchmarkColumn own_column(const std::string& label, const std::string& unit, const std::string& doc,
                                  graph::BenchmarkColumn::Best best = graph::BenchmarkColumn::Best::lowest);

/// Where a benchmark of many methods takes place: one frame in the scene and size asked for, or the usual
/// ones.
Experiment place_of(const BenchmarkOptions& options, glm::ivec2 usual_size);

/// Totals and ratios of all rows, peers too, as far as they are there.
void fill_ratios(BenchmarkReport& report);

}  // namespace ir::engine
