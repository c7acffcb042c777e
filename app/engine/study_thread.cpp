#include "app/engine/study_thread.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "app/engine/thread_priority.h"
#include "renderers/core/error.h"

namespace ir::engine {

struct StudyThread::State {
    struct Ended {
        std::string tag;
        std::uint64_t serial;
    };

    StudyRunner runner;
    std::function<void()> on_idle;  ///< on the study's thread, when nothing is left to do
    Callbacks callbacks;

    mutable std::mutex mutex;
    std::condition_variable woken;
    std::deque<StudyRequest> waiting;
    std::vector<Ended> cancelled;  ///< while they waited, and not told yet
    std::string running_tag;
    std::uint64_t running = 0;  ///< serial; 0: nothing runs
    bool is_silent = false;     ///< nobody wants to hear of what runs any more
    std::shared_ptr<CancelToken> token;
    std::uint64_t serials = 0;
    bool stops = false;
    std::thread thread;

    std::optional<StudyRequest> study_take();
    void study_loop();
    void study_run(const StudyRequest& request);
    void study_tell_cancelled();
    bool is_wanted(std::uint64_t serial) const;
    std::vector<Ended> drop(const std::string& tag, bool silently);
};

namespace {

/// A machine that is made with the first study and given back when there is nothing to do.
struct LazyMachine {
    MachineOptions options;  ///< of the machine
    std::unique_ptr<Machine> machine;

    ErrorStudy run(const StudyRequest& request, const StudyCallbacks& callbacks) {
        if (!(request.machine == options)) machine.reset();
        if (!machine) machine = std::make_unique<Machine>(options = request.machine);
        machine->context().make_current();
        try {
            return run_error_study(*machine, request.project, request.plot, request.folder, callbacks);
        } catch (const Error&) {
            if (machine->context().is_lost()) machine.reset();
            throw;
        }
    }
};

}  // namespace

StudyThread::StudyThread(StudyRunner runner, Callbacks callbacks) : state_(std::make_unique<State>()) {
    state_->runner = std::move(runner);
    state_->callbacks = std::move(callbacks);
    state_->thread = std::thread([this] { state_->study_loop(); });
}

StudyThread::StudyThread(Callbacks callbacks) : state_(std::make_unique<State>()) {
    auto lazy = std::make_shared<LazyMachine>();
    state_->runner = [lazy](const StudyRequest& request, const StudyCallbacks& told) {
        return lazy->run(request, told);
    };
    state_->on_idle = [lazy] { lazy->machine.reset(); };
    state_->callbacks = std::move(callbacks);
    state_->thread = std::thread([this] { state_->study_loop(); });
}

StudyThread::~StudyThread() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stops = true;
        state_->is_silent = true;
        state_->waiting.clear();
        if (state_->token) state_->token->cancel();
    }
    state_->woken.notify_one();
    state_->thread.join();
}

std::uint64_t StudyThread::request(StudyRequest request) {
    std::uint64_t serial = 0;
    {
        const std::lock_guard lock(state_->mutex);
        state_->drop(request.tag, true);
        serial = request.serial = ++state_->serials;
        state_->waiting.push_back(std::move(request));
    }
    state_->woken.notify_one();
    return serial;
}

void StudyThread::cancel(const std::string& tag) {
    {
        const std::lock_guard lock(state_->mutex);
        const auto dropped = state_->drop(tag, false);
        state_->cancelled.insert(state_->cancelled.end(), dropped.begin(), dropped.end());
    }
    state_->woken.notify_one();
}

void StudyThread::release(const std::string& tag) {
    const std::lock_guard lock(state_->mutex);
    state_->drop(tag, true);
}

bool StudyThread::is_busy() const {
    const std::lock_guard lock(state_->mutex);
    return state_->running != 0 || !state_->waiting.empty();
}

/// Ends what waits or runs of a tag; returns those that waited. Needs the lock.
std::vector<StudyThread::State::Ended> StudyThread::State::drop(const std::string& tag, bool silently) {
    std::vector<Ended> dropped;
    std::erase_if(waiting, [&](const StudyRequest& request) {
        if (request.tag != tag) return false;
        dropped.push_back({tag, request.serial});
        return true;
    });
    if (silently) std::erase_if(cancelled, [&](const Ended& ended) { return ended.tag == tag; });
    if (running != 0 && running_tag == tag) {
        is_silent = is_silent || silently;
        token->cancel();
    }
    return dropped;
}

bool StudyThread::State::is_wanted(std::uint64_t serial) const {
    const std::lock_guard lock(mutex);
    return running == serial && !is_silent;
}

/// The next request, now running; nothing when the thread is to end.
std::optional<StudyRequest> StudyThread::State::study_take() {
    std::unique_lock lock(mutex);
    running = 0;
    if (waiting.empty() && cancelled.empty() && !stops && on_idle) {
        lock.unlock();
        on_idle();
        lock.lock();
    }
    while (true) {
        woken.wait(lock, [this] { return stops || !waiting.empty() || !cancelled.empty(); });
        if (stops) return {};
        if (!waiting.empty()) break;
        lock.unlock();
        study_tell_cancelled();
        lock.lock();
    }
    auto request = std::move(waiting.front());
    waiting.pop_front();
    running_tag = request.tag;
    running = request.serial;
    is_silent = false;
    token = std::make_shared<CancelToken>();
    return request;
}

void StudyThread::State::study_tell_cancelled() {
    std::vector<Ended> ended;
    {
        const std::lock_guard lock(mutex);
        ended.swap(cancelled);
    }
    for (const auto& each : ended)
        if (callbacks.on_failure) callbacks.on_failure(each.tag, each.serial, "cancelled", true);
}

void StudyThread::State::study_run(const StudyRequest& request) {
    const auto serial = request.serial;
    StudyCallbacks told;
    std::shared_ptr<CancelToken> own;
    {
        const std::lock_guard lock(mutex);
        own = token;
    }
    told.cancel = own.get();
    told.point = [&](const ErrorPoint& point) {
        if (callbacks.on_point && is_wanted(serial)) callbacks.on_point(request.tag, serial, point);
    };
    told.progress = [&](const std::string& what, double fraction) {
        study_tell_cancelled();
        if (callbacks.on_progress && is_wanted(serial))
            callbacks.on_progress(request.tag, serial, what, fraction);
    };
    const auto fail = [&](const std::string& error, bool is_cancelled) {
        if (callbacks.on_failure && is_wanted(serial))
            callbacks.on_failure(request.tag, serial, error, is_cancelled);
    };
    try {
        told.memory_budget = request.memory_budget;
        auto study = runner(request, told);
        if (callbacks.on_finished && is_wanted(serial))
            callbacks.on_finished(request.tag, serial, std::move(study));
    } catch (const Cancelled&) {
        fail("cancelled", true);
    } catch (const std::exception& error) {
        fail(error.what(), false);
    }
}

void StudyThread::State::study_loop() {
    give_way_to_others();
    while (const auto request = study_take()) {
        study_tell_cancelled();
        study_run(*request);
    }
    if (on_idle) on_idle();
}

}  // namespace ir::engine
