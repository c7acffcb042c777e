#include "app/engine/render_thread.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "app/engine/live_session.h"

namespace ir::engine {
namespace {

using Clock = std::chrono::steady_clock;

/// A newer request lets the frame that runs finish, so that a dragged camera shows pictures on its way,
/// unless that frame already runs this long.
constexpr auto patience = std::chrono::milliseconds(1500);
constexpr auto shader_poll = std::chrono::milliseconds(700);

struct Waiting {
    LiveRequest request;
    std::uint64_t serial = 0;
};

}  // namespace

struct RenderThread::State {
    Machine::Options options;
    Callbacks callbacks;
    std::mutex mutex;
    std::condition_variable wake;
    std::map<std::string, Waiting> waiting;  ///< newest request by tag
    std::deque<std::vector<scene::Part>> scenes;
    std::map<std::string, Waiting> latest;  ///< by tag, to run again after a reload
    std::string running_tag;
    Clock::time_point running_since;
    CancelToken cancel;
    std::uint64_t serial = 0;
    bool reload = false, stop = false;
    std::thread thread;

    void render_loop();
    void render_request(LiveSession& session, Waiting job);
    void render_scene(Machine& machine, const std::vector<scene::Part>& parts);
    void render_reload(Machine& machine, LiveSession& session);
    bool newer_is_waiting(const std::string& tag) {
        const std::lock_guard lock(mutex);
        return stop || waiting.count(tag) > 0;
    }
};

RenderThread::RenderThread(Machine::Options options, Callbacks callbacks)
    : state_(std::make_unique<State>()) {
    state_->options = std::move(options);
    state_->callbacks = std::move(callbacks);
    state_->thread = std::thread([this] { state_->render_loop(); });
}

RenderThread::~RenderThread() {
    {
        const std::lock_guard lock(state_->mutex);
        state_->stop = true;
        state_->cancel.cancel();
    }
    state_->wake.notify_all();
    state_->thread.join();
}

std::uint64_t RenderThread::request(LiveRequest request) {
    const std::lock_guard lock(state_->mutex);
    const auto serial = ++state_->serial;
    const auto tag = request.tag;
    state_->waiting[tag] = {std::move(request), serial};
    if (state_->running_tag == tag && Clock::now() - state_->running_since > patience)
        state_->cancel.cancel();
    state_->wake.notify_all();
    return serial;
}

void RenderThread::load_scene(std::vector<scene::Part> parts) {
    const std::lock_guard lock(state_->mutex);
    state_->scenes.push_back(std::move(parts));
    state_->wake.notify_all();
}

void RenderThread::cancel(const std::string& tag) {
    const std::lock_guard lock(state_->mutex);
    state_->waiting.erase(tag);
    if (state_->running_tag == tag) state_->cancel.cancel();
}

void RenderThread::reload_shaders() {
    const std::lock_guard lock(state_->mutex);
    state_->reload = true;
    state_->wake.notify_all();
}

void RenderThread::State::render_loop() {
    std::unique_ptr<Machine> machine;
    std::unique_ptr<LiveSession> session;
    const auto start = [&] {
        session.reset();
        machine.reset();
        machine = std::make_unique<Machine>(options);
        session = std::make_unique<LiveSession>(*machine);
        const auto& info = machine->context().info();
        if (callbacks.on_ready) callbacks.on_ready(gl::to_string(info.backend), info.renderer);
    };
    try {
        start();
    } catch (const std::exception& error) {
        if (callbacks.on_no_device) callbacks.on_no_device(error.what());
        return;
    }
    for (;;) {
        Waiting job;
        std::vector<scene::Part> scene;
        bool has_job = false, has_scene = false, check_shaders = false;
        {
            std::unique_lock lock(mutex);
            const bool woken = wake.wait_for(
                lock, shader_poll, [&] { return stop || reload || !waiting.empty() || !scenes.empty(); });
            if (stop) return;
            check_shaders = reload || !woken;
            reload = false;
            if (!scenes.empty()) {
                scene = scenes.front();
                scenes.pop_front();
                has_scene = true;
            } else if (!waiting.empty()) {
                job = std::move(waiting.begin()->second);
                waiting.erase(waiting.begin());
                latest[job.request.tag] = job;
                running_tag = job.request.tag;
                running_since = Clock::now();
                cancel.reset();
                has_job = true;
            }
        }
        if (has_scene) render_scene(*machine, scene);
        if (has_job) render_request(*session, std::move(job));
        if (check_shaders) render_reload(*machine, *session);
        {
            const std::lock_guard lock(mutex);
            running_tag.clear();
        }
        if (machine->context().is_lost()) {
            if (callbacks.on_messages)
                callbacks.on_messages(
                    {{Severity::warning, "gl", "the OpenGL context was lost and is made anew"}});
            try {
                start();
            } catch (const std::exception& error) {
                if (callbacks.on_no_device) callbacks.on_no_device(error.what());
                return;
            }
            const std::lock_guard lock(mutex);
            for (const auto& [tag, again] : latest) waiting.try_emplace(tag, again);
        }
    }
}

void RenderThread::State::render_request(LiveSession& session, Waiting job) {
    const auto& tag = job.request.tag;
    const ProgressCallback progress = [&](const std::string& what, double fraction) {
        if (callbacks.on_progress) callbacks.on_progress(tag, what, fraction);
    };
    try {
        for (;;) {
            auto result = session.advance(job.request, job.serial, cancel, progress);
            const bool finished = result.finished;
            if (callbacks.on_result) callbacks.on_result(std::move(result));
            if (finished || newer_is_waiting(tag)) return;
            const std::lock_guard lock(mutex);
            running_since = Clock::now();
        }
    } catch (const Cancelled&) {
        if (!newer_is_waiting(tag) && callbacks.on_failure) callbacks.on_failure(tag, "cancelled", true);
    } catch (const std::exception& error) {
        if (callbacks.on_failure) callbacks.on_failure(tag, error.what(), false);
    }
}

void RenderThread::State::render_scene(Machine& machine, const std::vector<scene::Part>& parts) {
    try {
        const auto scene = machine.scenes().load(parts);
        if (callbacks.on_scene) callbacks.on_scene(summarise(*scene));
    } catch (const std::exception& error) {
        if (callbacks.on_failure) callbacks.on_failure("scene", error.what(), false);
    }
}

void RenderThread::State::render_reload(Machine& machine, LiveSession& session) {
    machine.context().make_current();
    bool changed = false;
    auto messages = machine.programs().reload_changed(&changed);
    if (!messages.empty() && callbacks.on_messages) callbacks.on_messages(std::move(messages));
    if (!changed) return;
    session.forget_results();
    const std::lock_guard lock(mutex);
    for (const auto& [tag, again] : latest) waiting.try_emplace(tag, again);
}

}  // namespace ir::engine
