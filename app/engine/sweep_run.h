#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "app/engine/study_reference.h"
#include "app/engine/sweep_table.h"
#include "projects/match.h"

namespace ir::engine {

/// How variations are rendered, judged and timed.
struct SweepOptions {
    bool is_judged = false;     ///< by the ground truth of each
    std::uint64_t samples = 0;  ///< of the ground truths; 0: as *Match* has it
    int repeats = 0;            ///< warm runs after the first, whose median time counts
    /// Folder in which ground truths are looked for and put, as KEY.exr; empty: each run renders its own.
    std::filesystem::path references = {};
    graph::FrameOptions frame = {};                          ///< with progress of one variation
    std::function<void(const std::string& line)> note = {};  ///< what a reader of the numbers should know
};

/// Renders variations of a sweep one by one. Render thread only.
class SweepRun {
  public:
    SweepRun(Machine& machine, const projects::Project& project, std::filesystem::path folder,
             SweepOptions options);

    /// What the variation is; nothing of it is rendered yet. Why it cannot be judged is its problem.
    SweepRow planned(const projects::SweepPoint& point) const;

    /// Returns the file of the picture (SweepRow::image).
    using Pictured = std::function<std::string(const Execution& execution, const FrameReport& report)>;
    /// Completes a planned row; `pictured` is told of the first run, whose picture counts, before others. An
    /// Error, also of `pictured`, becomes the row's problem, and `was_refused` says whether the project is at
    /// fault. Throws Cancelled, and Error where the device is lost.
    void render(const projects::SweepPoint& point, SweepRow& row, const Pictured& pictured,
                bool& was_refused);
    /// Seconds that ground truths took until now.
    double reference_seconds() const { return reference_seconds_; }

  private:
    projects::Experiment ground_truth(const projects::SweepPoint& point) const;
    const StudyReference& reference_of(const projects::SweepPoint& point, const std::string& key);
    StudyReference rendered_reference(const projects::SweepPoint& point);
    FrameReport run(Execution& execution);
    double warm_ms(Execution& execution);
    void complete(const projects::SweepPoint& point, SweepRow& row, const Pictured& pictured);

    Machine& machine_;
    const projects::Project& project_;
    const projects::Project now_;  ///< with the content of its files
    const std::filesystem::path folder_;
    const SweepOptions options_;
    const projects::SceneFacts facts_;
    std::map<std::string, StudyReference> references_;  ///< by key
    double reference_seconds_ = 0;
    graph::FrameOptions frame_;
    int step_ = 0, steps_ = 1;  ///< of the variation: ground truth, first run, warm runs
};

}  // namespace ir::engine
