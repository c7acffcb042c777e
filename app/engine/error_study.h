#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/engine/execution.h"
#include "projects/document.h"
#include "renderers/core/progress.h"
#include "renderers/core/shard.h"

namespace ir::engine {

/// One picture of a study, measured against the reference.
struct ErrorPoint {
    std::string experiment;  ///< id
    projects::Json value;    ///< of what the plot runs over
    int frames = 1;
    double ms = 0;                         ///< of rendering, all frames; median of the repeats
    std::map<std::string, double> errors;  ///< by metric
    std::size_t pixels = 0, skipped = 0;
    std::uint64_t memory_bytes = 0;
    std::string problem;      ///< not empty: one line why there is no picture; the numbers say nothing then
    bool is_refused = false;  ///< with a problem: the document is at fault, not the rendering; not stored
    bool on_front = false;    ///< no other point is as good in both time and error, and better in one
};

/// A document's ErrorPlot, carried out.
struct ErrorStudy {
    std::string plot;                  ///< id
    std::vector<std::string> metrics;  ///< of the errors
    std::string device;
    double reference_noise = 0;      ///< RMSE that the reference itself has left; 0: unknown
    std::vector<std::string> notes;  ///< what a reader of the numbers should know, a line each
    std::vector<ErrorPoint> points;  ///< in the order of experiments, then values
};

struct StudyCallbacks {
    const CancelToken* cancel = nullptr;
    ProgressCallback progress;
    std::function<void(const ErrorPoint&)> point;  ///< as soon as it is there; fronts are not marked yet
    int repeats = 1;                               ///< runs of which the median time counts
    std::uint64_t memory_budget = 0;               ///< bytes of one execution; 0 = none
    /// Only these of the runs: experiments, and where a plot runs over values all of an experiment's.
    Shard shard = {};
    bool keeps_reference = false;  ///< in the project's results, also with fewer samples when cancelled
};

/// Renders reference and experiments and measures all metrics that apply. A reference that is kept with
/// enough samples is read, not rendered. Throws Cancelled, Error, InputError, UsageError with one line.
ErrorStudy run_error_study(Machine& machine, const projects::Project& project,
                           const projects::ErrorPlot& plot, const std::filesystem::path& folder,
                           const StudyCallbacks& callbacks = {});

/// Those that some point has.
void find_metrics(ErrorStudy& study);
/// Marks the points that no other is better than in time and error at once.
void mark_front(std::vector<ErrorPoint>& points, const std::string& metric);

std::string study_json(const ErrorStudy& study);
ErrorStudy study_from_json(const std::string& json, const std::string& file);
/// One row a point, a heading first.
std::string study_csv(const ErrorStudy& study);

}  // namespace ir::engine
