#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/engine/experiment.h"
#include "renderers/gl/context.h"
#include "renderers/gl/program.h"
#include "renderers/graph/graph.h"
#include "renderers/image/exr.h"
#include "renderers/scene/world.h"

namespace ir::engine {

/// All methods of this build.
const Registry& registry();

/// Loaded scenes, shared between executions. Not thread-safe: belongs to the render thread.
class SceneCache {
  public:
    std::shared_ptr<const scene::Scene> load(const std::string& name);
    /// Files are read once, however their parts move and change.
    std::shared_ptr<const scene::Scene> load(const std::vector<scene::Part>& parts);
    /// Loads again when the files changed on disk.
    void forget(const std::string& name);

  private:
    std::map<std::string, std::shared_ptr<const scene::Scene>> scenes_;
    std::map<std::string, std::weak_ptr<const scene::Scene>> compositions_;  ///< while somebody uses them
    std::shared_ptr<const scene::Scene> newest_composition_;
};

struct MachineOptions {
    std::string backend;  ///< "egl", "osmesa", empty: the best
    std::string device;
    bool debug = false;
    int threads = 0;  ///< for cpu passes; 0 = all
};

/// A context, its device and its programs: made once per render thread.
class Machine {
  public:
    using Options = MachineOptions;
    explicit Machine(const Options& options = {});
    ~Machine();
    gl::Context& context() { return *context_; }
    gl::Device& device() { return *device_; }
    gl::ProgramLibrary& programs() { return *programs_; }
    SceneCache& scenes() { return scenes_; }
    const Options& options() const { return options_; }

  private:
    Options options_;
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::Device> device_;
    std::unique_ptr<gl::ProgramLibrary> programs_;
    SceneCache scenes_;
};

/// One experiment at one camera and size: owns graph, history and accumulation. Render thread only.
class Execution {
  public:
    Execution(Machine& machine, Experiment experiment);

    const Experiment& experiment() const { return experiment_; }
    const MethodDescription& method() const;
    /// Key of the resource that holds the main result.
    std::string main_key() const;
    const scene::Scene& scene() const { return *scene_; }
    const scene::World& world() const { return world_; }

    /// Changes what can be changed without losing buffers; resets the history where the picture changes, and
    /// returns whether it did.
    bool update(Experiment experiment);

    /// What the next frame, or explain(), explains.
    void inspect(Inspection inspection) { inspection_ = std::move(inspection); }

    /// Back to an empty history; buffers stay.
    void restart();
    /// The next frame goes on from a stored history as if it had been its previous frame.
    void restore(graph::History history);

    /// Runs the next frame; frames are 1/30 s apart. Throws as Graph::run.
    FrameReport run_frame(const graph::FrameOptions& options);
    /// Computes what the last frame left out, and explains again after inspect(), on the contents of that
    /// frame. Throws and returns as Graph::explain.
    bool explain(const graph::FrameOptions& options);
    int committed_frames() const { return frame_; }

    graph::Graph& graph() { return *graph_; }
    const graph::Graph& graph() const { return *graph_; }
    /// What the last frame was made from (valid until the next one); without a scene before the first, and
    /// after update() has loaded another scene.
    const graph::FrameInputs& inputs() const { return inputs_; }
    /// The main result and its valid mask after the last frame.
    Image main_result() const;
    /// Default layer with the main result, "valid", and each resource that matches a pattern: images as they
    /// are (levels and layers as "key.level1", "key.layer3"), buffers as images with a channel per field, at
    /// most 4096 wide.
    std::vector<ImageLayer> layers(const std::vector<std::string>& patterns) const;
    /// Parameters, seed, camera, scene hash, versions: for the EXR header.
    ImageAttributes attributes() const;

    /// The camera in force, after the first frame.
    scene::Camera camera() const;

  private:
    void load();
    std::string world_fingerprint() const;
    Machine& machine_;
    Experiment experiment_;
    const graph::Method* method_ = nullptr;
    std::shared_ptr<const scene::Scene> scene_;
    scene::World world_;
    double world_time_ = -1;
    std::unique_ptr<graph::Graph> graph_;
    std::optional<scene::View> previous_view_;
    Settings settings_;
    Inspection inspection_;
    graph::FrameInputs inputs_;
    int frame_ = 0;
};

/// The statistics JSON of the command line (design contract): backend, device, wall_ms, passes, counters,
/// memory_bytes, …
std::string statistics_json(const FrameReport& report, int indent = 2);

}  // namespace ir::engine
