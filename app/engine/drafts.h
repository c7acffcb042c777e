#pragma once

#include <memory>
#include <optional>

#include "app/engine/draft_choice.h"
#include "app/engine/execution.h"
#include "app/engine/live.h"

namespace ir::engine {

/// The pictures of an experiment that come before the full one, coarse to fine. They have executions of their
/// own, so that the full one's history never sees them. Render thread only.
class Drafts {
  public:
    Drafts(Machine& machine, std::shared_ptr<graph::SharedContents> shared)
        : machine_(machine), shared_(std::move(shared)) {}

    /// Draws a preview of next to nothing, so that the first one of a scene waits for no compiler.
    static void compile_preview(Machine& machine);

    /// Another picture is asked for. The first draft is the finest that lets a hand follow, else the preview;
    /// there is none where the full picture is as quick.
    void begin(const Experiment& experiment);
    /// No draft is wanted (any more).
    void skip() { next_ = Fineness::full; }
    /// The next draft; empty: it is the full picture's turn. What fails is left out, as the full picture will
    /// say why. Throws Cancelled.
    std::optional<LiveResult> render(const LiveRequest& request, const graph::FrameOptions& options);
    /// Tells how long the full picture takes while nothing but the camera moves.
    void note_full(const FrameReport& report) {
        choice_.note(Fineness::full, steady_ms(report, report.wall_ms));
    }
    /// While the full picture is looked at: frees what is not worth its memory, and what takes more than the
    /// budget leaves over, that many bytes.
    void rest(std::uint64_t left_over);
    void free();
    std::uint64_t bytes() const;  ///< that they hold

  private:
    /// What stays the same while a camera moves.
    struct Subject {
        std::string method;
        std::vector<scene::Part> scene;
        int width = 0, height = 0;
        bool operator==(const Subject&) const = default;
    };
    static double steady_ms(const FrameReport& report, double ms);
    LiveResult render(Fineness fineness, const LiveRequest& request, graph::FrameOptions options);
    Execution& execution_for(std::unique_ptr<Execution>& execution, Experiment experiment);

    Machine& machine_;
    std::shared_ptr<graph::SharedContents> shared_;
    std::unique_ptr<Execution> preview_, coarse_;
    Subject subject_;
    std::string seen_;  ///< from where the newest picture sees the scene
    DraftChoice choice_;
    Fineness next_ = Fineness::full;
    Fineness coarse_was_ = Fineness::full;  ///< as which the coarse execution rendered this subject last
};

}  // namespace ir::engine
