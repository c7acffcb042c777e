#pragma once

#include <cstdint>
#include <functional>

#include "app/engine/execution.h"

namespace ir::engine {

/// How a run whose samples add up is put away on its way, so that another one goes on from there.
struct Checkpoints {
    static constexpr double usual_seconds = 60;
    /// Keeps what the execution has: its last frame is complete and counts fewer samples than asked for.
    /// Empty: nothing is put away.
    std::function<void(const FrameReport&)> keep;
    double seconds = usual_seconds;  ///< of rendering between two; 0: only when the run is interrupted
};

/// Samples of all pixels per second of rendering: a figure of the reports of run_frames().
inline constexpr const char* rate_figure = "samples_per_second";
/// "12 of 64 samples, 3.21 M samples/s"; the report is of run_frames().
std::string samples_text(const Execution& execution, const FrameReport& report);

/// Adds a message that is not there yet.
void add_message(std::vector<Message>& messages, const Message& message);

/// Passes that ran on the host and have a body for the device, too: what is changed in shaders does nothing
/// there.
std::vector<std::string> host_bodies(const FrameReport& report);
/// What a pass has written and can be looked at.
std::vector<const ResourceReport*> written_by(const FrameReport& report, const std::string& pass);

/// Cancelled, and the samples that were there could not be kept: what() says how many, and why.
class NotKept : public Cancelled {
  public:
    explicit NotKept(std::string what) : what_(std::move(what)) {}
    const char* what() const noexcept override { return what_.c_str(); }

  private:
    std::string what_;
};

/// Runs all frames that the experiment asks for. The report is that of the last, with the messages of all and
/// sums of `wall_ms` and of the counter "growth". Where samples add up the passes and FrameReport::sums are
/// those of all frames, too, and the rate_figure is there. Progress is that of all frames. With checkpoints
/// frames are divided into ones of some seconds, which changes no bit of the result; before Cancelled goes on
/// the samples of all complete frames are kept; where that fails it is a NotKept. A checkpoint that fails is
/// a warning. Throws as Execution::run_frame.
FrameReport run_frames(Execution& execution, const graph::FrameOptions& options,
                       const Checkpoints& checkpoints = {});

}  // namespace ir::engine
