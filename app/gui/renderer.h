#pragma once

#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "app/engine/render_thread.h"

namespace ir::gui {

/// Where pictures come from, as the window's thread sees it: every call returns at once, every answer is a
/// signal on the window's thread.
class Renderer : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    virtual std::uint64_t request(engine::LiveRequest request) = 0;
    virtual void cancel(const std::string& tag) = 0;
    /// Nobody looks at this tag any more.
    virtual void release(const std::string& tag) = 0;
    virtual std::uint64_t draw(engine::SceneViewRequest request) = 0;
    virtual void probe(engine::ProbeRequest request) = 0;
    virtual void find_surface(engine::SurfaceRequest request) = 0;
    virtual void export_layers(engine::ExportRequest request) = 0;
    virtual void keep(engine::KeepRequest request) = 0;
    virtual void load_scene(const std::vector<scene::Part>& parts) = 0;
    virtual void reload_shaders() = 0;
    /// For frames from now on.
    virtual void set_machine(const engine::MachineSettings& settings) = 0;

  signals:
    void result_arrived(std::shared_ptr<const ir::engine::LiveResult> result);
    void scene_view_arrived(std::shared_ptr<const ir::engine::SceneViewResult> result);
    void probe_arrived(std::shared_ptr<const ir::engine::ProbeResult> result);
    void surface_arrived(const ir::engine::SurfaceResult& result);
    /// `error` is empty when the file was written.
    void exported(const std::string& tag, const std::string& file, const std::string& error);
    void kept(const ir::engine::KeepResult& result);
    /// The fraction is that of all frames, those that were there before the request among them.
    void progressed(const std::string& tag, const std::string& what, double fraction);
    void failed(const std::string& tag, const std::string& error, bool cancelled);
    void scene_arrived(const ir::engine::SceneSummary& scene);
    void messages_arrived(const std::vector<ir::Message>& messages);
    /// All that there are now.
    void shader_faults_changed(const std::vector<ir::ShaderFault>& faults);
    void ready(const std::string& backend, const std::string& device);
    void no_device(const std::string& error);
};

/// The real one: posts the render thread's callbacks to the window's thread. Results that the window had no
/// time for are replaced by newer ones of their tag.
std::unique_ptr<Renderer> make_thread_renderer(const engine::Machine::Options& options);

}  // namespace ir::gui
