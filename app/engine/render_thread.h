#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/engine/execution.h"
#include "app/engine/live.h"
#include "app/engine/machine_settings.h"
#include "renderers/core/shader_fault.h"

namespace ir::engine {

/// The thread that owns the context. Function names with render_ run on it; all others are called from the
/// window's thread and return at once.
class RenderThread {
  public:
    /// All are called on the render thread; a window posts them to its own.
    struct Callbacks {
        std::function<void(LiveResult)> on_result;
        std::function<void(SceneViewResult)> on_scene_view;
        std::function<void(ProbeResult)> on_probe;
        std::function<void(SurfaceResult)> on_surface;
        /// `error` is empty when the file was written.
        std::function<void(std::string tag, std::string file, std::string error)> on_exported;
        std::function<void(KeepResult)> on_kept;
        std::function<void(std::string tag, std::string what, double fraction)> on_progress;
        /// Of a request by its tag, of a scene as tag "scene".
        std::function<void(std::string tag, std::string error, bool cancelled)> on_failure;
        std::function<void(SceneSummary)> on_scene;
        std::function<void(std::vector<Message>)> on_messages;  ///< shader reloads, GL
        /// All that are there now, whenever they are others than before.
        std::function<void(std::vector<ShaderFault>)> on_shader_faults;
        std::function<void(gl::DeviceInfo)> on_ready;
        std::function<void(std::string error)> on_no_device;
    };
    RenderThread(Machine::Options options, Callbacks callbacks);
    ~RenderThread();  ///< cancels and joins

    /// Drops an older request of the same tag that waits or runs. After each frame it is the next tag's turn.
    /// Returns the request's serial.
    std::uint64_t request(LiveRequest request);
    /// Nobody looks at this tag any more: its execution is freed, and no answer follows.
    void release(const std::string& tag);
    /// Drops what waits of this tag and stops its frame that runs; on_failure says when.
    void cancel(const std::string& tag);

    /// Served between the slices of any frame. Return the request's serial.
    std::uint64_t draw(SceneViewRequest request);
    void probe(ProbeRequest request);
    void find_surface(SurfaceRequest request);
    /// Waits until nothing of the tag is left to render.
    void export_layers(ExportRequest request);
    /// Waits likewise; on_kept answers.
    void keep(KeepRequest request);

    /// Loads a scene and reports its summary.
    void load_scene(std::vector<scene::Part> parts);
    /// Asks for reload of changed shaders; affected executions run again.
    void reload_shaders();
    /// For frames from now on; a frame that runs ends as it began.
    void set_machine(const MachineSettings& settings);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace ir::engine
