#pragma once

#include <string>

#include "app/engine/execution.h"

namespace ir::engine {

struct BenchmarkOptions {
    std::string scene;  ///< empty: the benchmark's own
    std::optional<scene::Camera> camera;
    int repeats = 5;
    bool json = false;
};

/// Names and one line each (or a JSON array).
std::string benchmark_list(bool json);

/// Runs a benchmark and returns its report, JSON or text: per pass the median milliseconds and bytes, cold
/// (first run) and warm. Throws UsageError for an unknown name.
std::string run_benchmark(Machine& machine, const std::string& name, const BenchmarkOptions& options);

}  // namespace ir::engine
