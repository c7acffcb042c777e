#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/experiment.h"
#include "app/engine/stored_state.h"
#include "renderers/gl/context.h"
#include "renderers/gl/program.h"
#include "renderers/graph/graph.h"
#include "renderers/graph/shared_contents.h"
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
    /// Of passes with two bodies; none: the host where the device is software, else gl.
    std::optional<Processor> processor = {};
    std::filesystem::path shaders = {};  ///< folder of the shaders; empty: the program's own
    bool operator==(const MachineOptions&) const = default;
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
    std::filesystem::path shader_folder() const;
    const Options& options() const { return options_; }
    Processor processor() const;
    /// For frames from now on, as MachineOptions has it.
    void set_processor(std::optional<Processor> processor) { options_.processor = processor; }
    void set_threads(int threads) { options_.threads = threads; }

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
    /// Executions with the same `shared` contents make what stands still once.
    Execution(Machine& machine, Experiment experiment,
              std::shared_ptr<graph::SharedContents> shared = nullptr);
    Execution(Execution&&) = default;
    ~Execution();  ///< whatever its changed shaders make wrong is forgotten

    const Experiment& experiment() const { return experiment_; }
    const MethodDescription& method() const;
    /// All values of the method's parameters.
    const Settings& settings() const { return settings_; }
    const scene::Scene& scene() const { return *scene_; }
    const scene::World& world() const { return world_; }

    /// Changes what can be changed without losing buffers; resets the history where the picture changes, and
    /// returns whether it did. Another number of samples, by frames or by a parameter that accumulates, is
    /// still the same picture: fewer than there are keep what is there; restart() for exactly as many.
    bool update(Experiment experiment);

    /// What the next frame, or explain(), explains.
    void inspect(Inspection inspection) { inspection_ = std::move(inspection); }

    /// Back to an empty history; buffers stay. The next frame is number `first`, at its time; what
    /// accumulates always begins with the first.
    void restart(int first = 0);
    /// With which frame the history began.
    int first_frame() const { return first_frame_; }
    /// Whether frames of other times show something else: camera, lights, or what the scene animates.
    bool is_moving() const;
    /// Seconds at which the last frame saw the scene; before the first that of the experiment.
    double time() const { return time_; }
    /// The next frames go on from a stored history as if it had been that of their previous frame, and add
    /// what the experiment asks for beyond it; where that is nothing, one frame only shows it. Throws Error
    /// where it is the state of another picture, the method does not accumulate, or the scene moves.
    void restore(StoredState state);
    /// What another execution could go on from: the history of the last committed frame. Empty where there is
    /// none, or where it could not be restored.
    std::optional<StoredState> state() const;
    /// The runs whose samples were restored; empty where all are this execution's own.
    const std::vector<StateOrigin>& origins() const { return origins_; }
    /// Whether this execution has added samples itself.
    bool is_extended() const { return is_extended_; }

    /// Runs the next frame, 1/30 s after the one before; at the experiment's time where the method
    /// accumulates. Where samples add up the frame adds at most `max_samples`; 0 only shows what is there,
    /// and without any sample adds one. Throws as Graph::run.
    FrameReport run_frame(const graph::FrameOptions& options, std::uint64_t max_samples = unlimited);
    static constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
    /// Computes what the last frame left out, and explains again after inspect(), on the contents of that
    /// frame. Throws and returns as Graph::explain.
    bool explain(const graph::FrameOptions& options);
    /// Frames of as many samples as the experiment asks for now; those of a restored state count.
    int committed_frames() const { return frame_; }
    /// In the history (projects/samples.h).
    std::uint64_t samples() const { return samples_; }
    /// Whether samples add up over frames, so that a state can be continued.
    bool accumulates() const;
    /// In the history of an experiment that is done, unless a restored state has more.
    std::uint64_t samples_requested() const;
    /// Whether all that the experiment asks for is committed and its picture is there.
    bool is_done() const { return shown_ && frame_ >= experiment_.frames; }

    graph::Graph& graph() { return *graph_; }
    const graph::Graph& graph() const { return *graph_; }
    /// What the last frame was made from (valid until the next one); without a scene before the first, and
    /// after update() has loaded another scene.
    const graph::FrameInputs& inputs() const { return inputs_; }
    /// The camera in force, after the first frame.
    scene::Camera camera() const;

  private:
    void check_size() const;  ///< throws UsageError
    void load();
    void forget_frames();
    double seconds_per_frame() const;
    void move_world(double time);
    std::string geometry_fingerprint() const;
    std::uint64_t samples_per_frame() const;
    std::uint64_t sample_limit(std::uint64_t limit) const;
    void count_frame(const FrameReport& report, std::uint64_t limit);
    void set_samples(std::uint64_t samples);
    Machine& machine_;
    Experiment experiment_;
    const graph::Method* method_ = nullptr;
    std::shared_ptr<const scene::Scene> scene_;
    scene::World world_;
    double world_time_ = -1, world_previous_ = -1, lights_time_ = -1;
    std::vector<scene::Light> own_lights_;  ///< of the world, without the experiment's motions
    double time_ = 0;
    std::unique_ptr<graph::Graph> graph_;
    std::optional<scene::View> previous_view_;
    Settings settings_;
    Inspection inspection_;
    graph::FrameInputs inputs_;
    int frame_ = 0, first_frame_ = 0;
    std::uint64_t samples_ = 0;
    bool shown_ = false;        ///< the contents are those of the history
    bool is_extended_ = false;  ///< since the history was empty or restored
    std::vector<StateOrigin> origins_;
};

/// The preview's, too. Throws UsageError for an unknown one.
const graph::Method& find_method(const std::string& id);

/// What emits in its scene, with what the method's picture has of each.
std::vector<UsedLight> used_lights(const Execution& execution);
/// Of the output "lit"; nothing where there is none.
std::vector<UsedLight> lights_of_lit(const Execution& execution);

/// Of everything that a state of the experiment depends on, given the content hash of its scene.
std::string state_fingerprint(const Experiment& experiment, const std::string& scene_hash);

/// The statistics JSON of the command line (design contract): picture (method, values, scene, size, seed,
/// camera), backend, device, wall_ms, passes, counters, memory_bytes, …
std::string statistics_json(const Execution& execution, const FrameReport& report);

}  // namespace ir::engine
