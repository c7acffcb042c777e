#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/engine/drafts.h"
#include "app/engine/execution.h"
#include "app/engine/live.h"
#include "renderers/passes/viewers/draw.h"

namespace ir::passes {
class Bvh;
}

namespace ir::engine {

/// What the render thread keeps for its live requests: one execution per tag. Render thread only.
class LiveSession {
  public:
    explicit LiveSession(Machine& machine) : machine_(machine) {}
    ~LiveSession();

    struct Step {
        const CancelToken* cancel = nullptr;
        /// Of all frames of the request, those that were there before among them; of an explanation by
        /// itself. The first word of a frame is how much was there before it.
        ProgressCallback progress;
        std::function<void()> between_slices;  ///< serves draw() and probe()
    };
    /// Runs the next draft or frame that the request needs, or none when everything is there, and reads back
    /// what is asked for. Throws as Execution::run_frame.
    LiveResult advance(const LiveRequest& request, std::uint64_t serial, const Step& step);

    /// Frees an execution.
    void release(const std::string& tag);

    /// Draws buffers as they are now, also between the slices of a frame. What cannot be drawn is said in the
    /// result.
    SceneViewResult draw(const SceneViewRequest& request, std::uint64_t serial);

    /// Texels as they are now, also between the slices of a frame. No rows where nothing was rendered.
    ProbeResult probe(const ProbeRequest& request) const;

    /// Without the device, and before anything was rendered, too.
    SurfaceResult find_surface(const SurfaceRequest& request);
    /// How many trees such questions have built.
    int surface_trees() const { return surface_trees_; }

    /// Writes the last frame, which must be whole. Throws Error.
    void export_layers(const ExportRequest& request) const;

    /// Keeps the last frame, which must be whole and what the experiment asks for. Returns the result's key.
    /// Throws Error.
    std::string keep(const KeepRequest& request);

    /// Forgets results and all contents that passes keep (after a shader changed), keeping scenes.
    void forget_results();

  private:
    struct Entry {
        std::unique_ptr<Execution> execution;
        std::unique_ptr<Drafts> drafts;
        std::unique_ptr<passes::viewers::Viewer> viewer;  ///< made when it is first drawn
        std::vector<std::string> wanted;                  ///< patterns asked for since the history was empty
        std::vector<std::string> tried;                   ///< what the report's frame was asked for
        FrameReport report;
        std::uint64_t run = 0;                ///< of the report's frame
        bool rebuild = false;                 ///< kept contents are of an older shader
        bool whole = false;                   ///< the contents are those of one complete frame
        std::vector<std::string> versions;    ///< kept of the report's frame
        std::optional<glm::ivec2> traced;     ///< in the report's frame
        glm::ivec2 picked{-1};                ///< likewise, for what shaders say
        std::optional<Inspection> explained;  ///< of the explanations that are there
        bool begins = true;                   ///< the history is empty and may begin with a stored one
        std::string state_file;               ///< that was tried last
        std::vector<Message> state_messages;  ///< why it is not what the history begins with
    };
    std::optional<LiveResult> draft(Entry& entry, const LiveRequest& request, const Step& step);
    static bool lacks(const Entry& entry, const LiveRequest& request);
    static bool lacks_steps(const Entry& entry, const LiveRequest& request);
    static bool is_explained(const Entry& entry, const LiveRequest& request);
    void update(Entry& entry, const LiveRequest& request);
    static int first_frame(const LiveRequest& request);
    static void begin(Entry& entry, const LiveRequest& request);
    static void restart(Entry& entry, const LiveRequest& request);
    static graph::FrameOptions frame_options(const Entry& entry, const LiveRequest& request,
                                             const Step& step);
    static bool explain(Entry& entry, const LiveRequest& request, const Step& step);
    void run_frame(Entry& entry, const LiveRequest& request, const Step& step);

    /// Of the last question about a surface; another scene, or another moment of it, gets one of its own.
    struct SurfaceTree;
    const passes::Bvh& surface_tree(const Execution& execution, const scene::World& world);
    /// Of a scene that is released.
    void drop_unused_tree();

    Machine& machine_;
    std::shared_ptr<SurfaceTree> surface_tree_;
    std::shared_ptr<graph::SharedContents> shared_ = std::make_shared<graph::SharedContents>();
    std::map<std::string, Entry> entries_;
    std::uint64_t runs_ = 0;  ///< frames that ran
    int surface_trees_ = 0;
};

/// What a request asks to see of an execution's contents.
void read_back(LiveResult& result, const LiveRequest& request, const Execution& execution);

/// A reduced copy, at most `width` pixels wide, of an image.
Image thumbnail(const Image& image, int width);

/// Without what only its parts tell: their key and variants.
SceneSummary summarise(const scene::Scene& scene);

}  // namespace ir::engine
