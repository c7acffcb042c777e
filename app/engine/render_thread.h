#pragma once

#include <functional>
#include <memory>
#include <string>

#include "app/engine/execution.h"

namespace ir::engine {

/// What a view asks to see of an experiment.
struct LiveRequest {
    std::string tag;  ///< requests of one tag replace each other; the newest wins
    Experiment experiment;
    std::string shown;  ///< resource key to send back; empty: the main result
    int level = 0, layer = 0;
    bool thumbnails = false;  ///< also send a small image of each image resource
    std::uint64_t memory_budget = 0;
};

/// Sent back, on the render thread, through the callbacks given to the constructor; a window posts them to
/// its own.
struct LiveResult {
    std::string tag;
    std::uint64_t serial = 0;  ///< of the request
    int frame = 0, frames = 1;
    std::string shown;
    Image image;                              ///< the shown resource (empty when it is not available)
    Image valid;                              ///< 1 channel, may be empty
    std::map<std::string, Image> thumbnails;  ///< at most 96 pixels wide, by resource key
    FrameReport report;
    bool finished = false;  ///< all frames asked for are committed
};

struct SceneSummary {
    std::string name, content_hash;
    std::vector<std::string> cameras, lights, materials, warnings;
    struct NodeRow {
        std::string name;
        int parent = -1;
        std::size_t triangles = 0;
    };
    std::vector<NodeRow> nodes;
    std::size_t triangles = 0, textures = 0;
    scene::Bounds bounds;
    std::vector<scene::Camera> camera_values;
};

/// The thread that owns the context. Function names with render_ run on it; all others are called from the
/// window's thread and return at once.
class RenderThread {
  public:
    struct Callbacks {
        std::function<void(LiveResult)> on_result;
        std::function<void(std::string tag, std::string what, double fraction)> on_progress;
        std::function<void(std::string tag, std::string error, bool cancelled)> on_failure;
        std::function<void(SceneSummary)> on_scene;
        std::function<void(std::vector<Message>)> on_messages;  ///< shader reloads, GL
        std::function<void(std::string backend, std::string device)> on_ready;
        std::function<void(std::string error)> on_no_device;
    };
    RenderThread(Machine::Options options, Callbacks callbacks);
    ~RenderThread();  ///< cancels and joins

    /// Drops an older request of the same tag that waits or runs. Returns the request's serial.
    std::uint64_t request(LiveRequest request);
    /// Loads a scene and reports its summary.
    void load_scene(std::vector<scene::Part> parts);
    void cancel(const std::string& tag);
    /// Asks for reload of changed shaders; affected executions run again.
    void reload_shaders();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace ir::engine
