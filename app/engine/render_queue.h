#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/engine/live.h"
#include "app/engine/machine_settings.h"
#include "renderers/core/progress.h"

namespace ir::engine {

/// What waits for the render thread. The window's side adds, the render thread takes; every function may be
/// called from any thread.
class RenderQueue {
  public:
    struct Job {
        LiveRequest request;
        std::uint64_t serial = 0;
    };
    struct View {
        SceneViewRequest request;
        std::uint64_t serial = 0;
    };
    /// What the render thread does next; the frame comes last.
    struct Work {
        bool stop = false, check_shaders = false;
        std::vector<std::string> released, cancelled;  ///< tags
        std::optional<MachineSettings> settings;
        std::optional<std::vector<scene::Part>> scene;
        std::optional<ExportRequest> file;
        std::optional<KeepRequest> kept;
        std::optional<Job> job;
    };

    std::uint64_t request(LiveRequest request);
    std::uint64_t draw(SceneViewRequest request);
    void probe(ProbeRequest request);
    void find_surface(SurfaceRequest request);
    void export_layers(ExportRequest request);
    void keep(KeepRequest request);
    void load_scene(std::vector<scene::Part> parts);
    void release(const std::string& tag);
    void cancel(const std::string& tag);
    void reload_shaders();
    void set_machine(const MachineSettings& settings);
    void stop();

    /// Waits for work, or for the time to look at shader files.
    Work take();
    /// After a frame of `job`: the tag's next frame waits for its turn unless this was the last one. Whether
    /// somebody waits to hear that it failed, or that it was cancelled with frames left.
    enum class Outcome { drafts, more, finished, failed };  ///< drafts: more of them are left
    bool finish(const Job& job, Outcome outcome);
    /// What waits to be looked at now; what comes meanwhile waits until the next slice is done.
    struct Looks {
        std::vector<ProbeRequest> probes;
        std::vector<SurfaceRequest> surfaces;
        std::vector<View> views;
    };
    Looks take_looks();
    /// All requests that are known, again; also those that failed, but none that was cancelled.
    void run_all_again();
    /// Of the frame that runs.
    const CancelToken& cancel_token() const { return cancel_; }
    /// To be called between slices: cancels a frame whose picture nobody waits for any more.
    void cancel_if_overdue();

  private:
    using Clock = std::chrono::steady_clock;
    struct Known {
        Job job;
        bool active = false;     ///< frames are left to render
        bool cancelled = false;  ///< by hand, with frames left
        bool answered = false;   ///< something of the picture was sent
        bool drafts = false;     ///< are left: they come before the full frames of other tags
        bool yields = false;     ///< made way, and waits until another's full frame is done
    };
    void give_turn(const std::string& tag);
    bool has_work() const;
    static bool is_another_picture(const LiveRequest& request, const LiveRequest& than);
    bool is_in_the_way(const LiveRequest& request) const;
    bool runs_longer_than(std::chrono::milliseconds patience) const;
    bool is_active(const std::string& tag) const;
    /// The first of `requests` whose tag has nothing left to render.
    template <class Request>
    std::optional<Request> take_ready(std::deque<Request>& requests);
    void drop_turn(const std::string& tag);
    std::string take_turn();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::map<std::string, Known> jobs_;  ///< newest by tag
    std::deque<std::string> turns_;      ///< tags with frames to render, except the one that runs
    std::map<std::string, View> views_;
    std::map<std::string, ProbeRequest> probes_;
    std::map<std::pair<std::string, std::string>, SurfaceRequest> surfaces_;  ///< by tag and asker
    std::deque<ExportRequest> files_;
    std::deque<KeepRequest> keeps_;
    std::deque<std::vector<scene::Part>> scenes_;
    std::vector<std::string> released_, cancelled_;
    std::optional<MachineSettings> settings_;
    Job running_job_;
    bool running_ = false;
    bool running_answered_ = false;  ///< something of its picture was sent before
    bool running_draft_ = false;     ///< as far as is known
    bool makes_way_ = false;         ///< the frame was cancelled for another tag's, and is tried again
    Clock::time_point running_since_;
    Clock::time_point next_poll_;  ///< of shader files
    CancelToken cancel_;
    std::uint64_t serial_ = 0;
    bool reload_ = false, stop_ = false;
};

}  // namespace ir::engine
