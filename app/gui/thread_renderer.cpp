#include <mutex>
#include <optional>

#include "app/gui/renderer.h"

namespace ir::gui {
namespace {

class ThreadRenderer final : public Renderer {
  public:
    explicit ThreadRenderer(const engine::Machine::Options& options)
        : thread_(std::make_unique<engine::RenderThread>(options, callbacks())) {}
    ~ThreadRenderer() override { thread_.reset(); }  // no callback comes after this

    std::uint64_t request(engine::LiveRequest request) override {
        return thread_->request(std::move(request));
    }
    void load_scene(const std::vector<scene::Part>& parts) override { thread_->load_scene(parts); }
    void cancel(const std::string& tag) override { thread_->cancel(tag); }
    void reload_shaders() override { thread_->reload_shaders(); }

  private:
    struct Progress {
        std::string tag, what;
        double fraction = 0;
    };

    template <class Function>
    void post(Function function) {
        QMetaObject::invokeMethod(this, std::move(function), Qt::QueuedConnection);
    }

    engine::RenderThread::Callbacks callbacks() {
        engine::RenderThread::Callbacks c;
        c.on_result = [this](engine::LiveResult result) { render_result(std::move(result)); };
        c.on_progress = [this](std::string tag, std::string what, double fraction) {
            render_progress({std::move(tag), std::move(what), fraction});
        };
        c.on_failure = [this](std::string tag, std::string error, bool cancelled) {
            post([this, tag, error, cancelled] { emit failed(tag, error, cancelled); });
        };
        c.on_scene = [this](engine::SceneSummary scene) {
            post([this, scene] { emit scene_arrived(scene); });
        };
        c.on_messages = [this](std::vector<Message> messages) {
            post([this, messages] { emit messages_arrived(messages); });
        };
        c.on_ready = [this](std::string backend, std::string device) {
            post([this, backend, device] { emit ready(backend, device); });
        };
        c.on_no_device = [this](std::string error) { post([this, error] { emit no_device(error); }); };
        return c;
    }

    // Fast methods make results quicker than a window draws them: only the newest waits in the queue.
    void render_result(engine::LiveResult result) {
        auto shared = std::make_shared<const engine::LiveResult>(std::move(result));
        const std::lock_guard lock(mutex_);
        const bool posted = waiting_result_ != nullptr;
        waiting_result_ = std::move(shared);
        if (!posted) post([this] { deliver_result(); });
    }
    void deliver_result() {
        std::shared_ptr<const engine::LiveResult> result;
        {
            const std::lock_guard lock(mutex_);
            result.swap(waiting_result_);
        }
        emit result_arrived(result);
    }
    void render_progress(Progress progress) {
        const std::lock_guard lock(mutex_);
        const bool posted = waiting_progress_.has_value();
        waiting_progress_ = std::move(progress);
        if (!posted) post([this] { deliver_progress(); });
    }
    void deliver_progress() {
        Progress progress;
        {
            const std::lock_guard lock(mutex_);
            progress = *waiting_progress_;
            waiting_progress_.reset();
        }
        emit progressed(progress.tag, progress.what, progress.fraction);
    }

    std::mutex mutex_;
    std::shared_ptr<const engine::LiveResult> waiting_result_;
    std::optional<Progress> waiting_progress_;
    std::unique_ptr<engine::RenderThread> thread_;  // last member: starts when the rest exists
};

}  // namespace

std::unique_ptr<Renderer> make_thread_renderer(const engine::Machine::Options& options) {
    return std::make_unique<ThreadRenderer>(options);
}

}  // namespace ir::gui
