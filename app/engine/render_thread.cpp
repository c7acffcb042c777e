#include "app/engine/render_thread.h"

#include <optional>
#include <thread>

#include "app/engine/drafts.h"
#include "app/engine/live_session.h"
#include "app/engine/render_queue.h"
#include "app/engine/shader_watch.h"
#include "app/engine/thread_priority.h"
#include "renderers/core/reason.h"

namespace ir::engine {
namespace {
/// Whoever's picture takes the context with it each time is told so.
constexpr int most_losses = 3;
}  // namespace

struct RenderThread::State {
    Machine::Options options;
    Callbacks callbacks;
    RenderQueue queue;
    std::unique_ptr<Machine> machine;
    std::unique_ptr<LiveSession> session;
    int losses = 0;                   ///< of the context, since a picture was done
    std::vector<ShaderFault> faults;  ///< as told
    std::thread thread;
    std::optional<ShaderWatch> watch;  ///< while the thread runs

    bool is_lost() const { return machine->context().is_lost(); }
    void render_loop();
    bool render_start();
    void render_work(const RenderQueue::Work& work);
    void render_views();
    void render_frame(const RenderQueue::Job& job);
    void render_scene(const std::vector<scene::Part>& parts);
    void render_export(const ExportRequest& request);
    void render_keep(const KeepRequest& request);
    void render_reload();
    void render_faults();

    template <class Function, class... Values>
    static void tell(const Function& callback, Values&&... values) {
        if (callback) callback(std::forward<Values>(values)...);
    }
};

RenderThread::RenderThread(Machine::Options options, Callbacks callbacks)
    : state_(std::make_unique<State>()) {
    state_->options = std::move(options);
    state_->callbacks = std::move(callbacks);
    state_->thread = std::thread([this] { state_->render_loop(); });
}

RenderThread::~RenderThread() {
    state_->queue.stop();
    state_->thread.join();
}

std::uint64_t RenderThread::request(LiveRequest request) {
    return state_->queue.request(std::move(request));
}
void RenderThread::release(const std::string& tag) {
    state_->queue.release(tag);
}
void RenderThread::cancel(const std::string& tag) {
    state_->queue.cancel(tag);
}
std::uint64_t RenderThread::draw(SceneViewRequest request) {
    return state_->queue.draw(std::move(request));
}
void RenderThread::probe(ProbeRequest request) {
    state_->queue.probe(std::move(request));
}
void RenderThread::find_surface(SurfaceRequest request) {
    state_->queue.find_surface(std::move(request));
}
void RenderThread::export_layers(ExportRequest request) {
    state_->queue.export_layers(std::move(request));
}
void RenderThread::keep(KeepRequest request) {
    state_->queue.keep(std::move(request));
}
void RenderThread::load_scene(std::vector<scene::Part> parts) {
    state_->queue.load_scene(std::move(parts));
}
void RenderThread::reload_shaders() {
    state_->queue.reload_shaders();
}

void RenderThread::set_machine(const MachineSettings& settings) {
    state_->queue.set_machine(settings);
}

bool RenderThread::State::render_start() {
    session.reset();
    machine.reset();
    try {
        machine = std::make_unique<Machine>(options);
    } catch (const std::exception& error) {
        tell(callbacks.on_no_device, error.what());
        return false;
    }
    session = std::make_unique<LiveSession>(*machine);
    tell(callbacks.on_ready, machine->context().info());
    Drafts::compile_preview(*machine);
    return true;
}

void RenderThread::State::render_loop() {
    give_way_to_others();
    bool started = render_start();
    if (started) watch.emplace(machine->shader_folder(), [this] { queue.reload_shaders(); });
    while (started) {
        const auto work = queue.take();
        if (work.stop) break;
        render_work(work);
        if (!is_lost()) continue;
        if (++losses > most_losses) {
            tell(callbacks.on_no_device,
                 "the OpenGL context is lost again and again; start the program again");
            break;
        }
        tell(callbacks.on_messages,
             std::vector<Message>{
                 {Severity::warning, "gl", "the OpenGL context was lost and is made anew", {}}});
        started = render_start();
        queue.run_all_again();
    }
    watch.reset();
    session.reset();
    machine.reset();
}

void RenderThread::State::render_work(const RenderQueue::Work& work) {
    if (work.settings) {
        machine->set_processor(work.settings->chosen_processor());
        machine->set_threads(work.settings->threads);
        options = machine->options();
    }
    for (const auto& tag : work.released) session->release(tag);
    for (const auto& tag : work.cancelled) tell(callbacks.on_failure, tag, "cancelled", true);
    render_views();
    if (work.file) render_export(*work.file);
    if (work.kept) render_keep(*work.kept);
    if (work.scene) render_scene(*work.scene);
    if (work.job) render_frame(*work.job);
    if (work.check_shaders) render_reload();
    render_faults();
}

void RenderThread::State::render_views() {
    const auto looks = queue.take_looks();
    for (const auto& probe : looks.probes) tell(callbacks.on_probe, session->probe(probe));
    for (const auto& surface : looks.surfaces) tell(callbacks.on_surface, session->find_surface(surface));
    for (const auto& view : looks.views)
        tell(callbacks.on_scene_view, session->draw(view.request, view.serial));
}

void RenderThread::State::render_frame(const RenderQueue::Job& job) {
    using Outcome = RenderQueue::Outcome;
    const auto& tag = job.request.tag;
    LiveSession::Step step;
    step.cancel = &queue.cancel_token();
    step.progress = [&](const std::string& what, double fraction) {
        tell(callbacks.on_progress, tag, what, fraction);
    };
    // A frame that is being cancelled has no time for it.
    step.between_slices = [this] {
        queue.cancel_if_overdue();
        if (!queue.cancel_token().is_cancelled()) render_views();
    };
    try {
        auto result = session->advance(job.request, job.serial, step);
        const auto outcome = result.finished      ? Outcome::finished
                             : result.drafts_left ? Outcome::drafts
                                                  : Outcome::more;
        if (result.finished) losses = 0;
        tell(callbacks.on_result, std::move(result));
        if (queue.finish(job, outcome)) tell(callbacks.on_failure, tag, "cancelled", true);
    } catch (const Cancelled&) {
        if (queue.finish(job, Outcome::failed)) tell(callbacks.on_failure, tag, "cancelled", true);
    } catch (const std::exception& error) {
        // Where the context is lost all is rendered again.
        if (queue.finish(job, Outcome::failed) && !is_lost())
            tell(callbacks.on_failure, tag, reason_of(error), false);
    }
}

void RenderThread::State::render_scene(const std::vector<scene::Part>& parts) {
    try {
        auto summary = summarise(*machine->scenes().load(parts));
        summary.composition_key = scene::composition_key(parts);
        for (const auto& part : parts)
            summary.variants.push_back(machine->scenes().load(part.source)->variants);
        tell(callbacks.on_scene, std::move(summary));
    } catch (const std::exception& error) {
        tell(callbacks.on_failure, "scene", reason_of(error), false);
    }
}

void RenderThread::State::render_export(const ExportRequest& request) {
    std::string failure;
    try {
        session->export_layers(request);
    } catch (const std::exception& error) {
        failure = reason_of(error);
    }
    tell(callbacks.on_exported, request.tag, request.file, failure);
}

void RenderThread::State::render_keep(const KeepRequest& request) {
    KeepResult result{request.tag, request.experiment, {}, {}};
    try {
        result.key = session->keep(request);
    } catch (const std::exception& error) {
        result.error = reason_of(error);
    }
    tell(callbacks.on_kept, std::move(result));
}

void RenderThread::State::render_reload() {
    machine->context().make_current();
    bool changed = false;
    auto messages = machine->programs().reload_changed(&changed);
    if (!messages.empty()) tell(callbacks.on_messages, std::move(messages));
    if (!changed) return;
    look_at_shaders_again();
    session->forget_results();
    queue.run_all_again();
}

void RenderThread::State::render_faults() {
    auto now = machine->programs().faults();
    if (now == faults) return;
    faults = std::move(now);
    tell(callbacks.on_shader_faults, faults);
}

}  // namespace ir::engine
