#include "app/engine/error_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/engine/from_project.h"
#include "app/engine/measure.h"
#include "app/engine/median.h"
#include "app/engine/moving.h"
#include "app/engine/study_plan.h"
#include "app/engine/study_reference.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

using projects::Json;

/// With what accumulates over frames as little as it can be: for a first frame that only compiles, uploads
/// and grows.
Experiment with_min_samples(Experiment experiment) {
    for (const auto& parameter : registry().at(experiment.method).parameters)
        if (parameter.accumulates)
            experiment.settings[parameter.key] =
                parameter.checked(std::int64_t(std::max(1.0, std::ceil(parameter.hard.min))));
    return experiment;
}

class Study {
  public:
    Study(Machine& machine, const projects::Project& project, const projects::ErrorPlot& plot,
          const std::filesystem::path& folder, const StudyCallbacks& callbacks)
        : machine_(machine), project_(project), plot_(plot), folder_(folder), callbacks_(callbacks) {
        options_.cancel = callbacks.cancel;
        options_.memory_budget = callbacks.memory_budget;
    }

    ErrorStudy run() {
        const auto now = projects::with_contents(project_, projects::read_contents(project_, folder_));
        const auto runs =
            part_of(plan_study(now, plot_, scene_facts(machine_.scenes(), now, folder_)), callbacks_.shard);
        for (const auto& run : runs) points_ += run.points.size();
        study_.plot = plot_.id;
        study_.device = machine_.context().info().renderer;
        if (runs.empty()) return std::move(study_);
        options_.progress = [this](const std::string& what, double part) { tell(what, part); };
        reference_ = study_reference(machine_, project_, plot_.reference, folder_, options_,
                                     callbacks_.keeps_reference);
        study_.reference_noise = reference_.noise;
        study_.notes = reference_.notes;
        for (const auto& planned : runs) run_points(planned);
        find_metrics(study_);
        mark_front(study_.points, plot_.metric);
        return std::move(study_);
    }

  private:
    /// `part` of what is being worked on, which is `width_` points; the reference counts as one.
    void tell(const std::string& what, double part) {
        const double done = double(study_.points.size()) + (reference_.image.empty() ? 0 : 1);
        // Frames that warm up and runs that are repeated do not lead back.
        told_fraction_ =
            std::max(told_fraction_, std::min(1.0, (done + part * width_) / double(points_ + 1)));
        if (callbacks_.progress) callbacks_.progress(what, told_fraction_);
    }

    void check() const {
        if (callbacks_.cancel) callbacks_.cancel->check();
    }

    static void refuse(ErrorPoint& point, const std::string& problem, bool is_refused = true) {
        point.problem = problem;
        point.is_refused = is_refused && !problem.empty();
    }

    ErrorPoint blank(const PlannedRun& planned, const PlannedPoint& point) const {
        ErrorPoint result;
        result.experiment = planned.experiment;
        result.value = point.value;
        result.frames = point.frames;
        refuse(result, point.problem);
        return result;
    }

    /// All points of one execution, in their order. What fails is said at each of them.
    void run_points(const PlannedRun& planned) {
        std::vector<ErrorPoint> results;
        for (const auto& point : planned.points) results.push_back(blank(planned, point));
        width_ = double(results.size());
        told_.clear();
        const auto runnable = [](const PlannedPoint& point) { return point.problem.empty(); };
        const auto first = std::find_if(planned.points.begin(), planned.points.end(), runnable);
        if (first != planned.points.end()) {
            try {
                execute(planned, *first, results);
            } catch (const Error& error) {
                if (machine_.context().is_lost()) throw;
                for (auto& result : results)
                    if (result.problem.empty() && result.errors.empty())
                        refuse(result, projects::printable(error.what(), 300), is_refusal(error));
            }
        }
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (callbacks_.point && told_.count(i) == 0) callbacks_.point(results[i]);
            study_.points.push_back(std::move(results[i]));
        }
    }

    /// One more frame; its progress is a part of the point at hand.
    FrameReport frame(Execution& execution, const std::string& id, int last) {
        check();
        options_.progress = [this, id, last, done = execution.committed_frames()](const std::string& what,
                                                                                  double part) {
            tell(id + ": " + what, (done + part) / last);
        };
        return execution.run_frame(options_);
    }

    /// Everything is compiled, uploaded and as large as it has to be afterwards; the history is empty.
    void warm_up(Execution& execution, const Experiment& experiment, const std::string& id) {
        execution.update(with_min_samples(experiment));
        frame(execution, id, experiment.frames);
        execution.update(experiment);
        execution.restart();
    }

    /// Milliseconds from the first frame to each, the reports, and at some frames the pictures. False when a
    /// buffer grew meanwhile, so that the times say nothing.
    bool time_frames(Execution& execution, const PlannedRun& planned, int last, std::vector<double>& ms,
                     std::vector<ErrorPoint>* results) {
        execution.restart();
        ms.clear();
        bool grew = false;
        for (int n = 1; n <= last; ++n) {
            const auto report = frame(execution, planned.experiment, last);
            grew = grew || (report.counters.count("growth") != 0 && report.counters.at("growth") > 0);
            ms.push_back((ms.empty() ? 0 : ms.back()) + report.wall_ms);
            for (std::size_t i = 0; results && i < results->size(); ++i) {
                if (!planned.points[i].problem.empty() || planned.points[i].frames != n) continue;
                auto& result = (*results)[i];
                measure(execution, report, result);
                result.ms = ms.back();
                if (grew || callbacks_.repeats > 1) continue;  // its time is not known yet
                if (callbacks_.point) callbacks_.point(result);
                told_.insert(i);
            }
        }
        return !grew;
    }

    void execute(const PlannedRun& planned, const PlannedPoint& first, std::vector<ErrorPoint>& results) {
        const auto experiment = from_project(project_, first.run, folder_);
        Execution execution(machine_, experiment);
        warm_up(execution, experiment, planned.experiment);
        find_moments(execution, planned);
        int last = 1;
        for (const auto& point : planned.points)
            if (point.problem.empty()) last = std::max(last, point.frames);
        std::vector<std::vector<double>> times;
        std::vector<double> ms;
        bool measured = false;
        // A buffer that grew in a later frame is large enough in the next run.
        for (int attempt = 0; int(times.size()) < callbacks_.repeats && attempt < 2 * callbacks_.repeats + 1;
             ++attempt) {
            const bool counts = time_frames(execution, planned, last, ms, measured ? nullptr : &results);
            measured = true;
            if (counts) times.push_back(ms);
        }
        if (times.empty()) times.push_back(ms);
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (!planned.points[i].problem.empty()) continue;
            std::vector<double> at;
            for (const auto& run : times) at.push_back(run[std::size_t(planned.points[i].frames - 1)]);
            if (told_.count(i) == 0) results[i].ms = median(at);
        }
    }

    /// Where something moves, frames are of different moments, and each is judged by the reference of its
    /// own.
    void find_moments(const Execution& execution, const PlannedRun& planned) {
        const auto* reference = find_item(project_.experiments, plot_.reference);
        if (!reference || !execution.is_moving()) return;
        for (const auto& point : planned.points) {
            if (!point.problem.empty()) continue;
            auto run = point.run;
            run.frames = point.frames;
            const double time = projects::last_time(run, registry());
            if (same_moment(time, projects::last_time(*reference, registry())) ||
                moments_.count(micros(time)))
                continue;
            auto then = project_;
            find_item(then.experiments, plot_.reference)->time = time;
            moments_[micros(time)] = study_reference(machine_, then, plot_.reference, folder_, options_);
            if (moments_.size() == 1)
                study_.notes.push_back(
                    "the scene moves: every number of frames is judged by the reference of its own moment");
        }
    }

    static std::int64_t micros(double seconds) { return std::llround(1e6 * seconds); }
    static bool same_moment(double a, double b) { return micros(a) == micros(b); }
    const StudyReference& reference_of(const Execution& execution) const {
        const auto found = moments_.find(micros(execution.time()));
        return execution.is_moving() && found != moments_.end() ? found->second : reference_;
    }

    void measure(Execution& execution, const FrameReport& report, ErrorPoint& point) {
        machine_.context().make_current();
        point.memory_bytes = report.memory_bytes;
        try {
            auto measured = engine::measure(execution, reference_of(execution), callbacks_.cancel);
            point.errors = std::move(measured.errors);
            point.pixels = measured.pixels;
            point.skipped = measured.skipped;
        } catch (const UsageError& error) {
            refuse(point, projects::printable(error.what(), 300));
        }
    }

    Machine& machine_;
    const projects::Project& project_;
    const projects::ErrorPlot& plot_;
    const std::filesystem::path& folder_;
    const StudyCallbacks& callbacks_;
    graph::FrameOptions options_;
    StudyReference reference_;
    std::map<std::int64_t, StudyReference> moments_;  ///< of other moments, by microseconds
    ErrorStudy study_;
    std::size_t points_ = 0;
    double width_ = 1, told_fraction_ = 0;
    std::set<std::size_t> told_;  ///< points of the run that callbacks know
};

}  // namespace

ErrorStudy run_error_study(Machine& machine, const projects::Project& project,
                           const projects::ErrorPlot& plot, const std::filesystem::path& folder,
                           const StudyCallbacks& callbacks) {
    if (callbacks.repeats < 1) throw UsageError("repeats: must be at least 1");
    return Study(machine, project, plot, folder, callbacks).run();
}

void find_metrics(ErrorStudy& study) {
    study.metrics.clear();
    for (const auto& name : metric_names())
        if (std::any_of(study.points.begin(), study.points.end(),
                        [&](const ErrorPoint& point) { return point.errors.count(name) != 0; }))
            study.metrics.push_back(name);
}

void mark_front(std::vector<ErrorPoint>& points, const std::string& metric) {
    const auto& known = metrics();
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const auto& each) { return each.name == metric; });
    struct Candidate {
        double ms, error;
        ErrorPoint* point;
    };
    std::vector<Candidate> candidates;
    for (auto& point : points) {
        point.on_front = false;
        const auto error = point.errors.find(metric);
        if (!point.problem.empty() || error == point.errors.end()) continue;
        const double bad = found == known.end() ? error->second : badness(*found, error->second);
        if (!std::isnan(bad)) candidates.push_back({point.ms, bad, &point});
    }
    const auto beats = [](const Candidate& a, const Candidate& b) {
        return a.ms <= b.ms && a.error <= b.error && (a.ms < b.ms || a.error < b.error);
    };
    for (const auto& candidate : candidates)
        candidate.point->on_front =
            std::none_of(candidates.begin(), candidates.end(),
                         [&](const Candidate& other) { return beats(other, candidate); });
}

}  // namespace ir::engine
