#include "app/engine/benchmark_thread.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

#include "app/engine/from_project.h"
#include "app/engine/thread_priority.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

Experiment place_of(const BenchmarkRequest::Place& place) {
    const auto* experiment = projects::find_item(place.project.experiments, place.experiment);
    if (!experiment) throw Error("the experiment '" + place.experiment + "' is gone; choose another place");
    return from_project(place.project, *experiment, place.folder);
}

}  // namespace

BenchmarkReport run_request(const BenchmarkRequest& request, const BenchmarkCallbacks& callbacks) {
    BenchmarkOptions chosen;
    if (request.place) chosen.place = place_of(*request.place);
    chosen.variants = request.variants;
    chosen.repeats = request.repeats;
    Machine machine(request.machine);
    return run_benchmark(machine, find_benchmark(request.name), chosen, callbacks);
}

struct BenchmarkThread::State {
    BenchmarkRunner runner;
    Callbacks callbacks;
    std::atomic<bool> busy{false}, silent{false};
    CancelToken token;
    std::thread thread;

    void benchmark_run(const BenchmarkRequest& request);
};

BenchmarkThread::BenchmarkThread(BenchmarkRunner runner, Callbacks callbacks)
    : state_(std::make_unique<State>()) {
    state_->runner = std::move(runner);
    state_->callbacks = std::move(callbacks);
}

BenchmarkThread::~BenchmarkThread() {
    state_->silent = true;
    state_->token.cancel();
    if (state_->thread.joinable()) state_->thread.join();
}

bool BenchmarkThread::start(BenchmarkRequest request) {
    if (state_->busy) return false;
    if (state_->thread.joinable()) state_->thread.join();  // has told its end
    state_->token.reset();
    state_->busy = true;
    state_->thread = std::thread([state = state_.get(), request = std::move(request)] {
        give_way_to_others();
        state->benchmark_run(request);
    });
    return true;
}

void BenchmarkThread::cancel() {
    state_->token.cancel();
}

bool BenchmarkThread::is_busy() const {
    return state_->busy;
}

void BenchmarkThread::State::benchmark_run(const BenchmarkRequest& request) {
    BenchmarkCallbacks told;
    told.cancel = &token;
    told.memory_budget = request.memory_budget;
    told.report = [this](const BenchmarkReport& report) {
        if (callbacks.on_report && !silent) callbacks.on_report(report);
    };
    told.progress = [this](const BenchmarkProgress& progress) {
        if (callbacks.on_progress && !silent) callbacks.on_progress(progress);
    };
    // Whoever hears of the end may start the next.
    const auto fail = [this](const std::string& error, bool is_cancelled) {
        busy = false;
        if (callbacks.on_failure && !silent) callbacks.on_failure(error, is_cancelled);
    };
    try {
        auto report = runner(request, told);
        busy = false;
        if (callbacks.on_finished && !silent) callbacks.on_finished(std::move(report));
    } catch (const Cancelled&) {
        fail("cancelled", true);
    } catch (const std::exception& error) {
        fail(error.what(), false);
    }
}

}  // namespace ir::engine
