#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/benchmark_report.h"
#include "app/engine/execution.h"
#include "renderers/core/progress.h"

namespace ir::engine {

struct NamedBenchmark {
    std::string method;  ///< id
    graph::Benchmark benchmark;
};

/// The benchmarks that methods bring along, and one with the defaults of each method.
const std::vector<NamedBenchmark>& benchmarks();
/// Throws UsageError that lists what there is.
const NamedBenchmark& find_benchmark(const std::string& name);
/// Of its table; the total, the ratio to each peer, and memory where it declares none.
std::vector<graph::BenchmarkColumn> columns_of(const graph::Benchmark& benchmark);
/// The scene, or the sources of its parts.
std::string name_of_scene(const Experiment& experiment);
/// Names and one line each (or a JSON array).
std::string benchmark_list(bool json);

struct BenchmarkOptions {
    /// Scene, camera, lights and time in place of the benchmark's own, which is used where it names no scene;
    /// then a camera alone may be given. All else in it does not count.
    Experiment place;
    std::optional<glm::ivec2> size;     ///< in pixels; none: the benchmark's own
    std::vector<std::string> variants;  ///< labels of those to run, in the benchmark's order; empty: all
    int repeats = 5;
};

struct BenchmarkProgress {
    std::string label;              ///< of the variant or peer
    std::size_t row = 0, rows = 0;  ///< the one that runs, and how many there are
    int repeat = 0, repeats = 0;    ///< 0 is the cold run; of 0 there is one run only
    std::string what;               ///< the pass that runs; empty: a peer
    double fraction = 0;            ///< of all rows
};

struct BenchmarkCallbacks {
    const CancelToken* cancel = nullptr;
    std::function<void(const BenchmarkProgress&)> progress;
    /// The report so far, whenever a row was added. Ratios to peers come with the peers.
    std::function<void(const BenchmarkReport&)> report;
    std::uint64_t memory_budget = 0;  ///< bytes of one execution; 0 = none
};

/// Times all variants, then the peers on the frame of the last one. A variant or peer that fails is a row
/// with its message, and the others still run. Throws UsageError for variants that there are not, InputError
/// for a scene that cannot be loaded, Cancelled.
BenchmarkReport run_benchmark(Machine& machine, const NamedBenchmark& named, const BenchmarkOptions& options,
                              const BenchmarkCallbacks& callbacks = {});

}  // namespace ir::engine
