#include <map>
#include <mutex>

#include "app/gui/renderer.h"

namespace ir::gui {
namespace {

/// The newest value of each tag on its way from the render thread to the window's. Fast methods make results
/// quicker than a window draws them: only the newest waits in the event queue.
template <class Value>
class Newest {
  public:
    /// Whether nothing of the tag was waiting, so that somebody has to come for it.
    bool put(const std::string& tag, Value value) {
        const std::lock_guard lock(mutex_);
        return waiting_.insert_or_assign(tag, std::move(value)).second;
    }
    /// A tag that was dropped meanwhile holds a default value.
    Value take(const std::string& tag) {
        const std::lock_guard lock(mutex_);
        auto node = waiting_.extract(tag);
        return node.empty() ? Value() : std::move(node.mapped());
    }

  private:
    std::mutex mutex_;
    std::map<std::string, Value> waiting_;
};

class ThreadRenderer final : public Renderer {
  public:
    explicit ThreadRenderer(const engine::Machine::Options& options)
        : thread_(std::make_unique<engine::RenderThread>(options, callbacks())) {}
    ~ThreadRenderer() override { thread_.reset(); }  // no callback comes after this

    std::uint64_t request(engine::LiveRequest request) override {
        return thread_->request(std::move(request));
    }
    void cancel(const std::string& tag) override { thread_->cancel(tag); }
    void release(const std::string& tag) override {
        thread_->release(tag);
        results_.take(tag);
        probes_.take(tag);
    }
    std::uint64_t draw(engine::SceneViewRequest request) override {
        return thread_->draw(std::move(request));
    }
    void probe(engine::ProbeRequest request) override { thread_->probe(std::move(request)); }
    void find_surface(engine::SurfaceRequest request) override { thread_->find_surface(std::move(request)); }
    void export_layers(engine::ExportRequest request) override { thread_->export_layers(std::move(request)); }
    void keep(engine::KeepRequest request) override { thread_->keep(std::move(request)); }
    void load_scene(const std::vector<scene::Part>& parts) override { thread_->load_scene(parts); }
    void reload_shaders() override { thread_->reload_shaders(); }
    void set_machine(const engine::MachineSettings& settings) override { thread_->set_machine(settings); }

  private:
    struct Progress {
        std::string what;
        double fraction = 0;
    };

    template <class Function>
    void post(Function function) {
        QMetaObject::invokeMethod(this, std::move(function), Qt::QueuedConnection);
    }

    /// Posts `signal(value)` unless an older value of the tag is still on its way: then it replaces that.
    template <class Result, class Signal>
    void render_newest(Newest<std::shared_ptr<const Result>>& newest, Result result, Signal signal) {
        const auto tag = result.tag;
        if (!newest.put(tag, std::make_shared<const Result>(std::move(result)))) return;
        post([this, &newest, tag, signal] {
            if (auto value = newest.take(tag)) emit(this->*signal)(std::move(value));
        });
    }

    void render_progress(const std::string& tag, Progress progress) {
        if (!progress_.put(tag, std::move(progress))) return;
        post([this, tag] {
            const auto newest = progress_.take(tag);
            emit progressed(tag, newest.what, newest.fraction);
        });
    }

    engine::RenderThread::Callbacks callbacks() {
        engine::RenderThread::Callbacks c;
        c.on_result = [this](engine::LiveResult result) {
            render_newest(results_, std::move(result), &Renderer::result_arrived);
        };
        c.on_scene_view = [this](engine::SceneViewResult result) {
            render_newest(views_, std::move(result), &Renderer::scene_view_arrived);
        };
        c.on_probe = [this](engine::ProbeResult result) {
            render_newest(probes_, std::move(result), &Renderer::probe_arrived);
        };
        c.on_surface = [this](engine::SurfaceResult result) {
            post([this, result = std::move(result)] { emit surface_arrived(result); });
        };
        c.on_exported = [this](std::string tag, std::string file, std::string error) {
            post([this, tag, file, error] { emit exported(tag, file, error); });
        };
        c.on_kept = [this](engine::KeepResult result) {
            post([this, result = std::move(result)] { emit kept(result); });
        };
        c.on_progress = [this](std::string tag, std::string what, double fraction) {
            render_progress(tag, {std::move(what), fraction});
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
        c.on_shader_faults = [this](std::vector<ShaderFault> faults) {
            post([this, faults = std::move(faults)] { emit shader_faults_changed(faults); });
        };
        c.on_ready = [this](const gl::DeviceInfo& info) {
            post([this, info] { emit ready(gl::to_string(info.backend), info.renderer); });
        };
        c.on_no_device = [this](std::string error) { post([this, error] { emit no_device(error); }); };
        return c;
    }

    Newest<std::shared_ptr<const engine::LiveResult>> results_;
    Newest<std::shared_ptr<const engine::SceneViewResult>> views_;
    Newest<std::shared_ptr<const engine::ProbeResult>> probes_;
    Newest<Progress> progress_;
    std::unique_ptr<engine::RenderThread> thread_;  // last member: starts when the rest exists
};

}  // namespace

std::unique_ptr<Renderer> make_thread_renderer(const engine::Machine::Options& options) {
    return std::make_unique<ThreadRenderer>(options);
}

}  // namespace ir::gui
