#include <algorithm>
#include <optional>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "app/engine/from_project.h"
#include "app/engine/part.h"
#include "app/engine/pictures.h"
#include "projects/samples.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"

namespace ir::engine {
namespace {

constexpr std::uint64_t max_bytes = 1ull << 30;  ///< of the pictures of all frames

/// A frame whose picture is wanted, and what it shows.
struct Frame {
    std::uint64_t end = 0;  ///< samples or frames of the run until then
    std::string label = {};
    PlotCell moment = {};  ///< its samples or its time
    Image values = {};
};

/// One execution that goes on from frame to frame.
class FrameSeries {
  public:
    explicit FrameSeries(AnalysisRun& run)
        : run_(run),
          execution_(run.machine(), from_project(run.project(), run.experiment(0), run.folder())),
          has_samples_(projects::accumulates(execution_.method())),
          part_(part_called(run.analysis().output)) {
        if (part_.key.empty()) part_.key = main_key(execution_);
        plan();
        run.expect(frames_.size() + (run.has_reference() ? 1 : 0));
    }

    std::vector<Frame> render() {
        std::uint64_t before = 0;
        for (auto& frame : frames_) {
            run_.check();
            advance(frame, before);
            read(frame);
            run_.count_picture();
            before = frame.end;
        }
        return std::move(frames_);
    }
    bool has_samples() const { return has_samples_; }
    bool is_moving() const { return !has_samples_ && execution_.is_moving(); }
    const ResourceReport& buffer() const { return buffer_; }

  private:
    std::uint64_t position() const {
        return execution_.accumulates() ? execution_.samples() : std::uint64_t(execution_.committed_frames());
    }

    /// Samples are divided evenly. Else they are the last frames, and those that come after them where the
    /// experiment has fewer; where each adds samples all the same, none comes after.
    void plan() {
        const auto wanted = std::uint64_t(run_.analysis().frames);
        const auto own = std::uint64_t(std::max(1, execution_.experiment().frames));
        const bool divides = execution_.accumulates();
        const auto last = divides        ? std::max<std::uint64_t>(1, execution_.samples_requested())
                          : has_samples_ ? own
                                         : std::max(own, wanted);
        const auto count = std::min(wanted, last);
        for (std::uint64_t i = 1; i <= count; ++i)
            frames_.push_back({divides ? last * i / count : last - count + i});
    }

    void advance(Frame& frame, std::uint64_t before) {
        const auto number = std::to_string(&frame - frames_.data() + 1);
        const auto what = "frame " + number + " of " + std::to_string(frames_.size());
        auto options = run_.frame_options([&] { return what; });
        options.wanted = {part_.key};
        options.progress = [&, tell = options.progress](const std::string& pass, double part) {
            const auto step = execution_.accumulates() ? frame.end - before : 1;
            tell(pass, (double(position() - before) + part * double(step)) / double(frame.end - before));
        };
        while (position() < frame.end) {
            const auto limit = execution_.accumulates() ? frame.end - position() : Execution::unlimited;
            report_ = execution_.run_frame(options, limit);
        }
        const auto samples = std::to_string(execution_.samples());
        if (has_samples_) {
            frame.label = samples + (execution_.samples() == 1 ? " sample" : " samples");
            frame.moment = {samples, double(execution_.samples())};
        } else {
            frame.label = "Frame " + std::to_string(frame.end);
            frame.moment = number_cell(execution_.time());
        }
    }

    void read(Frame& frame) {
        const auto& id = execution_.method().id;
        const auto* buffer = find_resource(report_, part_.key);
        if (!buffer) {
            std::vector<std::string> images;
            for (const auto& each : report_.resources)
                if (each.width > 0) images.push_back(each.key);
            throw UsageError("'" + projects::printable(part_.key, 60) + "' is no buffer of " + id +
                             known_are(part_.key, images));
        }
        if (buffer->width == 0)
            throw UsageError("'" + part_.key + "' is no image; choose a buffer that is one");
        const auto image = execution_.graph().read_image(part_.key, part_.level, part_.layer);
        if (!image)
            throw UsageError("'" + run_.analysis().output + "' of " + id +
                             " is not computed without a picked pixel, or has no such level or layer");
        buffer_ = *buffer;
        frame.values = run_.values(*image, execution_.graph().read_image("valid").value_or(Image()),
                                   buffer->semantic, "a frame");
        if (const auto bytes = frames_.size() * frame.values.pixels.size() * sizeof(float); bytes > max_bytes)
            throw UsageError(std::to_string(frames_.size()) + " frames of this size take " +
                             std::to_string(bytes >> 20) + " MiB, and " + std::to_string(max_bytes >> 20) +
                             " are allowed; ask for fewer");
    }

    AnalysisRun& run_;
    Execution execution_;
    const bool has_samples_;
    Part part_;
    std::vector<Frame> frames_;
    FrameReport report_;
    ResourceReport buffer_;
};

/// Of the pixels that are compared, how many have another value.
double share_that_differs(const AnalysisRun& run, const Image& a, const Image& b) {
    std::size_t differing = 0;
    const auto channels = std::size_t(a.channels);
    for (std::size_t pixel = 0; pixel < a.pixels.size() / channels; ++pixel) {
        const auto* begin = &a.pixels[pixel * channels];
        if (run.is_valid(pixel) && !std::equal(begin, begin + channels, &b.pixels[pixel * channels]))
            ++differing;
    }
    return double(differing) / double(std::max<std::size_t>(1, run.count_valid()));
}

}  // namespace

AnalysisResult last_frames(AnalysisRun& run) {
    std::optional<FrameSeries> series(std::in_place, run);
    auto frames = series->render();
    const auto buffer = series->buffer();
    const bool has_samples = series->has_samples(), is_moving = series->is_moving();
    series.reset();
    const bool is_judged = run.has_reference();
    const auto& truth = run.reference();
    const auto& names = categories_of(buffer.categories, "");
    const bool are_names =
        buffer.semantic == Semantic::id || (!names.empty() && frames.front().values.channels == 1);

    const std::string change = are_names ? "Pixels that change" : "Change";
    std::vector<std::string> headings{"Frame", has_samples ? "Samples" : "Time (s)", change};
    if (is_judged) headings.push_back(run.error_title(""));
    Bars bars(std::to_string(frames.size()) + " frames of " + run.name(0) + ": " + buffer.label,
              is_judged   ? headings.back()
              : are_names ? "Share of the pixels that change"
                          : run.error_title("the frame before"),
              headings);
    const auto key = [](std::size_t i) { return "frame" + std::to_string(i + 1); };
    bool has_changed = false;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto& values = frames[i].values;
        const double changed = i == 0      ? 0
                               : are_names ? share_that_differs(run, values, frames[i - 1].values)
                                           : run.rmse(values, frames[i - 1].values);
        has_changed = has_changed || changed != 0;
        std::vector<PlotCell> cells{{std::to_string(i + 1), double(i + 1)}, frames[i].moment};
        cells.push_back(i == 0 ? PlotCell{"—"} : are_names ? percent_cell(changed) : number_cell(changed));
        const double error = is_judged ? run.rmse(values, truth) : 0;
        if (is_judged) cells.push_back(number_cell(error));
        bars.begin_row(frames[i].label);
        bars.add(key(i), 0, is_judged ? error : changed, std::move(cells));
    }
    AnalysisResult result;
    for (std::size_t i = 0; i < frames.size(); ++i)
        result.pictures.push_back({key(i), frames[i].label, buffer.doc, false, names,
                                   std::move(frames[i].values),
                                   PicturedBuffer{buffer.semantic, buffer.unit, buffer.colour_map}});
    if (!has_changed)
        run.note("no frame differs from the one before: no samples add up, and nothing that is seen moves");
    if (is_moving && is_judged)
        run.note("the reference shows one moment, and errors of others are of motion, too");
    result.data = std::move(bars).finish(run.notes());
    return result;
}

}  // namespace ir::engine
