#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/engine/benchmarks.h"
#include "projects/document.h"

namespace ir::engine {

/// A benchmark to be run, with a copy of the experiment's document where it runs at that one's place.
struct BenchmarkRequest {
    struct Place {
        projects::Project project;
        std::string experiment;  ///< id
        std::filesystem::path folder;
    };
    std::string name;
    std::optional<Place> place;         ///< none: the benchmark's own scene and camera
    std::vector<std::string> variants;  ///< labels; empty: all
    int repeats = 5;
    MachineOptions machine = {};
    std::uint64_t memory_budget = 0;  ///< as BenchmarkCallbacks has it
};

/// Runs a benchmark; the thread calls it.
using BenchmarkRunner = std::function<BenchmarkReport(const BenchmarkRequest&, const BenchmarkCallbacks&)>;
/// On a machine that is made for it.
BenchmarkReport run_request(const BenchmarkRequest& request, const BenchmarkCallbacks& callbacks);

/// Runs one benchmark at a time on a thread of its own, beside the render thread, with a machine that is made
/// for it: nothing is warm that a cold run would have to do. It gives way to the window's thread but not to
/// the render thread, so that pictures rendered meanwhile make its times longer.
class BenchmarkThread {
  public:
    /// All are called on the benchmark's thread; a window posts them to its own. Each run ends with exactly
    /// one of on_finished and on_failure, unless the thread is destroyed before.
    struct Callbacks {
        std::function<void(BenchmarkReport)> on_report;  ///< so far
        std::function<void(BenchmarkProgress)> on_progress;
        std::function<void(BenchmarkReport)> on_finished;
        std::function<void(std::string error, bool cancelled)> on_failure;
    };
    BenchmarkThread(BenchmarkRunner runner, Callbacks callbacks);
    ~BenchmarkThread();  ///< cancels and joins

    // Called from the window's thread; both return at once.

    /// Whether it was started: not while one runs.
    bool start(BenchmarkRequest request);
    void cancel();
    bool is_busy() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace ir::engine
