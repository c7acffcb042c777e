#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/engine/sweep_run.h"
#include "app/engine/sweep_table.h"
#include "projects/sweep.h"

namespace ir::engine {

/// A sweep, or a shard of it, that is rendered into a folder, which exists.
struct SweepJob {
    projects::Project project;
    std::filesystem::path folder;  ///< of the project
    projects::Sweep sweep;
    std::filesystem::path out;
    Shard shard = {};
    bool is_judged = false;               ///< by the ground truth of each variation
    std::uint64_t samples = 0;            ///< of the ground truths; 0: as *Match* has it
    int repeats = 0;                      ///< warm runs of each
    bool has_pictures = true;             ///< of each ID.exr, ID.png, ID.json are written
    bool resumes = false;                 ///< what the folder has of this sweep stays
    std::vector<std::string> dumps = {};  ///< patterns of buffers that come as layers

    std::filesystem::path list() const { return out / (table_name(shard) + ".json"); }
    /// Has a line for each row as it ends.
    std::filesystem::path lines() const { return out / (table_name(shard) + ".jsonl"); }
};

/// Warm runs of each variation where nobody says how many.
constexpr int usual_repeats(bool is_judged) {
    return is_judged ? 1 : 0;
}

/// What is told of a sweep, on the thread that renders it. All but `frame` may be empty.
struct SweepCallbacks {
    graph::FrameOptions frame = {};                          ///< with progress of one variation
    std::function<void(const std::string& line)> note = {};  ///< what a reader of the numbers should know
    /// The rows before the first is rendered, and how many of them were there already.
    std::function<void(const SweepTable& table, std::size_t resumed)> planned = {};
    /// A row is about to be rendered. May wait, as long as nothing is to be rendered, and throw Cancelled.
    std::function<void(std::size_t row, const projects::SweepPoint& point)> begun = {};
    /// The run of a row whose picture counts; an Error becomes the row's problem.
    std::function<void(const Execution& execution, const FrameReport& report)> seen = {};
    /// `was_refused`: it has a problem because of the project.
    std::function<void(std::size_t row, const SweepRow& outcome, bool was_refused)> ended = {};
};

/// Writes ID.exr with the layers that match `dumps`, ID.png and ID.json. Returns the name of the first
/// (SweepRow::image). Throws Error.
std::string write_variation(const std::filesystem::path& folder, const std::string& id,
                            const Execution& execution, const FrameReport& report,
                            const std::vector<std::string>& dumps);

/// Renders the variations of `points`, which are all of the sweep's, one by one. In the job's folder
/// NAME.jsonl gets a line as each ends, and the list NAME.json is there from the beginning, so that it tells
/// what is not rendered yet however the sweep ends. `table` is always what is known. Render thread only.
/// Throws Cancelled, and Error where the device is lost or files cannot be written.
void run_sweep(Machine& machine, const SweepJob& job, const std::vector<projects::SweepPoint>& points,
               const SweepCallbacks& told, SweepTable& table);

/// A sweep that a machine of its own renders.
struct SweepRequest {
    SweepJob job;
    MachineOptions machine = {};
    std::uint64_t memory_budget = 0;  ///< bytes; 0: none
};
using SweepRunner = std::function<void(const SweepRequest&, const SweepCallbacks&)>;
/// Makes the job's folder where it is missing. Throws as run_sweep(), and UsageError for a sweep that has no
/// points.
void run_sweep_request(const SweepRequest& request, const SweepCallbacks& told);

/// What a window shows of a sweep before, between and after its runs.
struct SweepSheet {
    SweepTable table;
    std::vector<bool> stale;  ///< rendered, and another picture now
    /// The rows are those of the folder's lists, as the project's sweep has no such variations.
    bool is_foreign = false;
    std::string problem;  ///< one line: why the folder's lists cannot be read
    std::string refused;  ///< one line: why the sweep has no points
};

/// The sweep's variations with what `out` has of them; where there are none, the rows that `out` has. Of the
/// job project, sweep, folder and out are looked at.
SweepSheet look_at_sweep(const SweepJob& job, const Registry& registry,
                         const std::function<bool()>& is_cancelled);

}  // namespace ir::engine
