#include "app/engine/run_frames.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "renderers/core/error.h"

namespace ir::engine {
namespace {

/// Of a frame that may be interrupted: what it has added by then is lost.
constexpr double longest_frame_seconds = 5;
/// A frame is so much shorter than the time between two checkpoints.
constexpr double frames_per_checkpoint = 4;
/// A rate measured on few samples may be far off for many.
constexpr std::uint64_t max_growth = 8;
/// Numbers of samples that documents can tell by frames of about as many samples as they have.
constexpr std::uint64_t even_samples = 16;
/// Of the time of rendering that writing checkpoints may take.
constexpr double share_of_writing = 0.05;

class FrameRun {
  public:
    FrameRun(Execution& execution, const graph::FrameOptions& options, const Checkpoints& checkpoints)
        : execution_(execution),
          options_(options),
          checkpoints_(checkpoints),
          adds_up_(execution.accumulates()),
          kept_samples_(execution.samples()) {}

    FrameReport run() {
        try {
            while (!execution_.is_done()) {
                run_frame();
                if (is_checkpoint_due()) keep_checkpoint();
            }
        } catch (const Cancelled&) {
            put_away();
            throw;
        }
        return std::move(total_);
    }

  private:
    bool keeps() const { return checkpoints_.keep && adds_up_; }

    std::uint64_t max_samples() const {
        if (!keeps()) return Execution::unlimited;
        if (last_samples_ == 0) return 1;
        const double seconds =
            checkpoints_.seconds > 0
                ? std::min(longest_frame_seconds, checkpoints_.seconds / frames_per_checkpoint)
                : longest_frame_seconds;
        const double in_time = static_cast<double>(last_samples_) * 1000 * seconds / std::max(last_ms_, 1e-3);
        const auto limit = max_growth * last_samples_;
        const auto added = in_time < static_cast<double>(limit)
                               ? std::max<std::uint64_t>(1, static_cast<std::uint64_t>(in_time))
                               : limit;
        const auto end = execution_.samples() + added, even = end - end % even_samples;
        return (even > execution_.samples() ? even : end) - execution_.samples();
    }

    void run_frame() {
        const auto limit = max_samples();
        auto options = options_;
        if (options_.progress) options.progress = progress_of(limit);
        const auto before = execution_.samples();
        add(execution_.run_frame(options, limit), before);
    }

    /// "frame 3 of 10, trace"; of one frame the pass alone.
    std::string frame_text(const std::string& what) const {
        const int frames = execution_.experiment().frames;
        if (frames < 2) return what;
        const auto frame = "frame " + std::to_string(std::min(execution_.committed_frames() + 1, frames)) +
                           " of " + std::to_string(frames);
        return what.empty() ? frame : frame + ", " + what;
    }

    /// The fraction of all frames, whatever one of them adds.
    ProgressCallback progress_of(std::uint64_t limit) const {
        const auto frames = static_cast<double>(std::max(1, execution_.experiment().frames));
        if (!adds_up_)
            return [this, frames](const std::string& what, double part) {
                options_.progress(frame_text(what),
                                  std::min(1.0, (execution_.committed_frames() + part) / frames));
            };
        const auto requested = execution_.samples_requested(), before = execution_.samples();
        const auto added =
            std::min({limit, requested - std::min(requested, before),
                      std::max<std::uint64_t>(1, requested / static_cast<std::uint64_t>(frames))});
        return [this, requested, before, added, text = frame_text(samples_text(execution_, total_))](
                   const std::string&, double part) {
            options_.progress(
                text, std::min(1.0, (static_cast<double>(before) + part * static_cast<double>(added)) /
                                        static_cast<double>(std::max<std::uint64_t>(1, requested))));
        };
    }

    void add(FrameReport report, std::uint64_t before) {
        if (report.began_anew) before = kept_samples_ = 0;
        last_samples_ = execution_.samples() - before;
        last_ms_ = report.wall_ms;
        added_ += last_samples_;
        unkept_ms_ += report.wall_ms;
        report.wall_ms += total_.wall_ms;
        report.counters["growth"] += total_.counters["growth"];
        if (adds_up_) add_up(report);
        report.began_anew = report.began_anew || total_.began_anew;
        auto messages = std::move(total_.messages);
        for (const auto& message : report.messages) add_message(messages, message);
        report.messages = std::move(messages);
        total_ = std::move(report);
        if (!adds_up_ || added_ == 0 || !(total_.wall_ms > 0)) return;
        const auto& experiment = execution_.experiment();
        const double rate = static_cast<double>(added_) * experiment.width * experiment.height /
                            experiment.shard.count / total_.wall_ms * 1e3;
        total_.figures[rate_figure] = total_.counters[rate_figure] = rate;
    }

    /// However many frames the samples were divided into.
    void add_up(FrameReport& report) const {
        for (const auto& key : total_.sums)
            report.counters[key] = report.figures[key] += total_.figures.at(key);
        report.sums.insert(total_.sums.begin(), total_.sums.end());
        for (const auto& before : total_.passes) {
            const auto same = [&](const PassReport& pass) { return pass.name == before.name; };
            const auto pass = std::find_if(report.passes.begin(), report.passes.end(), same);
            if (pass == report.passes.end()) continue;
            pass->gpu_ms += before.gpu_ms;
            pass->cpu_ms += before.cpu_ms;
            pass->slices += before.slices;
            pass->culled = pass->culled && before.culled;
        }
    }

    /// Before the next frame would make what a crash takes with it too large.
    bool is_checkpoint_due() const {
        if (!keeps() || checkpoints_.seconds <= 0 || execution_.is_done() ||
            execution_.samples() <= kept_samples_)
            return false;
        return unkept_ms_ + last_ms_ > 1000 * checkpoints_.seconds &&
               unkept_ms_ * share_of_writing > writing_ms_;
    }

    void keep_checkpoint() {
        const auto start = Clock::now();
        try {
            checkpoints_.keep(total_);
            kept_samples_ = execution_.samples();
        } catch (const Error& error) {
            add_message(total_.messages, {Severity::warning, "checkpoint",
                                          std::string("a checkpoint was not kept: ") + error.what()});
        }
        writing_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        unkept_ms_ = 0;
    }

    /// A frame that was cancelled left no picture: one that adds nothing shows what its history holds.
    void put_away() {
        if (!keeps() || execution_.samples() <= kept_samples_) return;
        auto options = options_;
        options.cancel = nullptr;
        options.progress = nullptr;
        const auto samples = execution_.samples();
        try {
            add(execution_.run_frame(options, 0), samples);
            checkpoints_.keep(total_);
        } catch (const std::exception& error) {
            throw NotKept("could not keep " + std::to_string(samples) + " samples: " + error.what());
        }
    }

    using Clock = std::chrono::steady_clock;
    Execution& execution_;
    const graph::FrameOptions& options_;
    const Checkpoints& checkpoints_;
    const bool adds_up_;
    std::uint64_t kept_samples_;
    std::uint64_t last_samples_ = 0;  ///< that the last frame added
    std::uint64_t added_ = 0;
    double last_ms_ = 0, unkept_ms_ = 0, writing_ms_ = 0;
    FrameReport total_;
};

}  // namespace

std::vector<const ResourceReport*> written_by(const FrameReport& report, const std::string& pass) {
    std::vector<const ResourceReport*> written;
    for (const auto& each : report.passes)
        if (each.name == pass)
            for (const auto& key : each.writes)
                if (const auto* buffer = find_resource(report, key); buffer && buffer->available)
                    written.push_back(buffer);
    return written;
}

std::vector<std::string> host_bodies(const FrameReport& report) {
    std::vector<std::string> names;
    for (const auto& pass : report.passes)
        if (pass.has_two_bodies && pass.queue == "cpu" && !pass.culled) names.push_back(pass.name);
    return names;
}

void add_message(std::vector<Message>& messages, const Message& message) {
    const auto same = [&](const Message& known) { return known.text == message.text; };
    if (std::none_of(messages.begin(), messages.end(), same)) messages.push_back(message);
}

std::string samples_text(const Execution& execution, const FrameReport& report) {
    auto text = std::to_string(execution.samples()) + " of " + std::to_string(execution.samples_requested()) +
                " samples";
    const auto rate = report.figures.find(rate_figure);
    if (rate == report.figures.end()) return text;
    char number[32];
    std::snprintf(number, sizeof number, ", %.3g M samples/s", rate->second / 1e6);
    return text + number;
}

FrameReport run_frames(Execution& execution, const graph::FrameOptions& options,
                       const Checkpoints& checkpoints) {
    return FrameRun(execution, options, checkpoints).run();
}

}  // namespace ir::engine
