#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "app/engine/error_study.h"

namespace ir::engine {

/// A plot to be carried out, with a copy of the document that it is made from.
struct StudyRequest {
    std::string tag;  ///< whose study it is; a window's tags are plots
    projects::Project project;
    projects::ErrorPlot plot;
    std::filesystem::path folder;  ///< of the project
    std::uint64_t serial = 0;      ///< set by StudyThread::request
    MachineOptions machine = {};
    std::uint64_t memory_budget = 0;  ///< as StudyCallbacks has it
};

/// Runs a study; the thread calls it.
using StudyRunner = std::function<ErrorStudy(const StudyRequest&, const StudyCallbacks&)>;

/// Carries out error studies one after the other on a thread of its own, beside the render thread: with a
/// machine of its own, which lives as long as there is something to do. It gives way to the window's thread
/// but not to the render thread, so that pictures rendered meanwhile make its times longer: a window that
/// wants clean times renders nothing then.
class StudyThread {
  public:
    /// All are called on the study's thread, with the request's tag and serial; a window posts them to its
    /// own. Each request ends with exactly one of on_finished and on_failure, unless a newer one of its tag
    /// replaced it or its tag was released: then nothing more is told of it, but for a call that is under
    /// way.
    struct Callbacks {
        std::function<void(std::string tag, std::uint64_t serial, ErrorPoint)> on_point;
        std::function<void(std::string tag, std::uint64_t serial, std::string what, double fraction)>
            on_progress;
        /// With fronts marked by the plot's metric.
        std::function<void(std::string tag, std::uint64_t serial, ErrorStudy)> on_finished;
        std::function<void(std::string tag, std::uint64_t serial, std::string error, bool cancelled)>
            on_failure;
    };
    explicit StudyThread(Callbacks callbacks);
    /// With another way to run a study.
    StudyThread(StudyRunner runner, Callbacks callbacks);
    ~StudyThread();  ///< cancels and joins

    // Called from the window's thread; all return at once.

    /// Replaces an older request of the same tag that waits or runs. Returns the request's serial.
    std::uint64_t request(StudyRequest request);
    /// Ends what waits or runs of this tag; on_failure says when.
    void cancel(const std::string& tag);
    /// Nobody wants this tag's study any more.
    void release(const std::string& tag);
    /// Whether something waits or runs.
    bool is_busy() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace ir::engine
