#pragma once

#include <map>
#include <memory>
#include <string>

#include "app/engine/render_thread.h"

namespace ir::engine {

/// What the render thread keeps for its live requests: one execution per tag. Render thread only.
class LiveSession {
  public:
    explicit LiveSession(Machine& machine) : machine_(machine) {}

    /// Runs the next frame that the request needs, or none when everything is there, and reads back what is
    /// shown.
    LiveResult advance(const LiveRequest& request, std::uint64_t serial, const CancelToken& cancel,
                       const ProgressCallback& progress);

    /// Forgets results and all contents that passes keep (after a shader changed), keeping scenes.
    void forget_results();

  private:
    struct Entry {
        std::unique_ptr<Execution> execution;
        std::vector<std::string> wanted;  ///< what was shown since the execution started
        FrameReport report;
        bool rebuild = false;  ///< kept contents are of an older shader
    };
    Machine& machine_;
    std::map<std::string, Entry> entries_;
};

/// A reduced copy, at most `width` pixels wide, of an image.
Image thumbnail(const Image& image, int width);

SceneSummary summarise(const scene::Scene& scene);

}  // namespace ir::engine
