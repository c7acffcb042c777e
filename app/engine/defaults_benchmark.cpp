#include "app/engine/defaults_benchmark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <optional>

#include "app/engine/benchmark_cells.h"
#include "app/engine/convergence.h"
#include "app/engine/median.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "app/engine/study_reference.h"
#include "projects/match.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/transport.h"
#include "renderers/image/flat.h"
#include "renderers/image/metrics.h"

namespace ir::engine {
namespace {

using Column = graph::BenchmarkColumn;

/// Errors of the reference are measured at 1, 4, 16, … samples.
constexpr std::uint64_t sample_growth = 4;

/// How many times the reference's samples the long one has.
constexpr int truth_frames = 8;
/// Once the warm runs of a row took as long, there are no more of it.
constexpr double enough_ms = 10'000;

/// One transport, the reference's values for it, and the methods that compute it at their defaults.
struct Question {
    Settings values;
    std::vector<const MethodDescription*> methods;
};

/// What of a picture counts: all valid pixels, or flat ones only.
struct Region {
    Image mask;        ///< empty: all
    double noise = 0;  ///< RMSE that the long reference has left
    std::vector<ConvergencePoint> convergence;
};

/// In the order of the table's columns.
enum ColumnIndex { time, flat_rmse, flat_flip, flat_ratio, rmse, flip, mean_ratio, flat_ms, ms, flat_gain };

std::vector<Column> columns(bool is_light) {
    const std::string flip_name = is_light ? "HDR-ꟻLIP" : "ꟻLIP";
    const std::string on_flat = ", on pixels away from geometric edges.";
    const std::string without_noise = "From the long reference, whose own noise is taken off";
    const auto none = Column::Best::none;
    return {own_column("Time", "ms", "One frame with everything built anew; median of the warm runs."),
            own_column("RMSE flat", "", without_noise + on_flat),
            own_column(flip_name + " flat", "", "From the long reference" + on_flat),
            own_column("Mean flat", "", "Mean over the long reference's" + on_flat, none),
            own_column("RMSE", "", without_noise + "."),
            own_column(flip_name, "", "From the long reference."),
            own_column("Mean", "", "Mean over the long reference's.", none),
            own_column("Reference flat", "ms", "Time of the reference to the same RMSE" + on_flat, none),
            own_column("Reference", "ms", "Time of the reference to the same RMSE.", none),
            own_column("Reference flat / time", "",
                       "How many times as long the reference takes to the same RMSE" + on_flat,
                       Column::Best::highest)};
}

const MethodDescription& reference_method() {
    if (const auto* method = registry().reference()) return *method;
    throw UsageError("this build has no method that is the ground truth");
}

std::optional<Semantic> semantic_of(const MethodDescription& method, const Settings& values) {
    const auto* output = main_output(method, values);
    return output ? std::optional(output->semantic) : std::nullopt;
}

std::vector<Question> questions(const std::vector<std::string>& ids) {
    for (const auto& id : ids)
        if (registry().at(id).is_reference)
            throw UsageError("'" + id + "' is the reference, which is in every table");
    std::vector<Question> found;
    for (const auto* method : registry().methods()) {
        const bool is_chosen = ids.empty() || std::find(ids.begin(), ids.end(), method->id) != ids.end();
        if (method->is_reference || !is_chosen) continue;
        projects::Experiment run;
        run.method = method->id;
        const auto truth = projects::ground_truth(run, registry());
        if (semantic_of(*method, {}) != semantic_of(reference_method(), truth.values)) continue;
        auto same = std::find_if(found.begin(), found.end(),
                                 [&](const auto& question) { return question.values == truth.values; });
        if (same == found.end()) same = found.insert(same, {truth.values, {}});
        same->methods.push_back(method);
    }
    if (found.empty()) throw UsageError("the reference can judge none of these methods");
    return found;
}

/// "paths=ao max_distance=1": what of the transport is not the reference's default, and the paths.
std::string text_of(const Settings& values) {
    std::string text;
    for (const auto& parameter : reference_method().parameters) {
        const auto& value = values.at(parameter.key);
        if (!is_transport_key(parameter.key) || !is_active(parameter, values)) continue;
        if (parameter.key != "paths" && value == parameter.default_value) continue;
        text += (text.empty() ? "" : " ") + parameter.key + "=" + to_string(value);
    }
    return text;
}

/// One table.
class QuestionRun {
  public:
    /// Called with the work at hand, its repetition of how many, what runs, and the fraction of that.
    using Tell = std::function<void(const std::string& label, int repeat, int repeats,
                                    const std::string& what, double fraction)>;

    QuestionRun(Machine& machine, Experiment place, const Question& question, int repeats,
                const BenchmarkCallbacks& callbacks, Tell tell)
        : machine_(machine),
          place_(std::move(place)),
          question_(question),
          repeats_(repeats),
          tell_(std::move(tell)),
          semantic_(*semantic_of(reference_method(), question.values)) {
        options_.cancel = callbacks.cancel;
        options_.memory_budget = callbacks.memory_budget;
        report_.name = defaults_name;
        report_.doc = text_of(question.values);
        report_.method = reference_method().id;
        report_.columns = columns(is_light());
    }

    BenchmarkReport carry_out() {
        render_truth();
        add_reference();
        for (const auto* method : question_.methods) add_method(*method);
        return std::move(report_);
    }

  private:
    bool is_light() const { return semantic_ != Semantic::accessibility; }

    void at(const std::string& label, int repeat, int repeats) {
        if (options_.cancel) options_.cancel->check();
        options_.progress = [=, this](const std::string& what, double fraction) {
            tell_(label, repeat, repeats, what, fraction);
        };
        tell_(label, repeat, repeats, {}, 0);
    }

    Experiment experiment(const MethodDescription& method, const Settings& settings) const {
        auto result = place_;
        result.method = method.id;
        result.settings = settings;
        return result;
    }

    void render_truth() {
        at("long reference", 0, 0);
        auto run = experiment(reference_method(), question_.values);
        run.frames = truth_frames;
        run.seed = place_.seed + 1;  // noise that it shares with no picture
        Execution execution(machine_, run);
        auto options = options_;
        const auto& variance_key = reference_method().variance;
        options.wanted = {"gbuffer.geometric_normal", "gbuffer.position", variance_key};
        run_frames(execution, options);
        truth_ = picture_of(execution);
        const auto image = [&](const std::string& key) {
            auto found = execution.graph().read_image(key);
            if (!found) throw Error("the reference shows no '" + key + "'");
            return std::move(*found);
        };
        flat_.mask = flat_pixels(image("gbuffer.geometric_normal"), image("gbuffer.position"));
        for (std::size_t i = 0; i < truth_.valid.pixels.size(); ++i)
            if (!(truth_.valid.pixels[i] > 0.5f)) flat_.mask.pixels[i] = 0;
        const auto variance = image(variance_key);
        flat_.noise = noise_of(variance, flat_.mask);
        all_.noise = noise_of(variance, truth_.valid);
        add_note("errors are from " + std::to_string(execution.samples()) + " samples, whose own RMSE is ",
                 flat_.noise, all_.noise);
        const auto flat = std::count(flat_.mask.pixels.begin(), flat_.mask.pixels.end(), 1.0f);
        report_.notes.push_back(std::to_string(100 * flat / std::ssize(flat_.mask.pixels)) +
                                " % of the pixels are flat");
    }

    void add_note(const std::string& text, double flat, double all) {
        char numbers[80];
        std::snprintf(numbers, sizeof numbers, "%.3g flat, %.3g in all", flat, all);
        report_.notes.push_back(text + numbers);
    }

    std::map<std::string, double> judge(const BenchmarkPicture& picture, const Region& region,
                                        const std::vector<std::string>& metrics) const {
        const auto pointer = [](const Image& image) { return image.empty() ? nullptr : &image; };
        return compute_metrics(picture.image, truth_.image, metrics,
                               {.semantic = semantic_,
                                .valid_image = pointer(picture.valid),
                                .valid_reference = pointer(truth_.valid),
                                .mask = pointer(region.mask),
                                .cancel = options_.cancel})
            .values;
    }

    /// Without what the long reference is off by itself.
    static double squared_error(double rmse, const Region& region) {
        return rmse * rmse - region.noise * region.noise;
    }

    /// Times of the reference after growing numbers of samples, and its errors then.
    void add_reference() {
        const auto& method = reference_method();
        Execution execution(machine_, experiment(method, question_.values));
        const auto samples = execution.samples_requested();
        std::map<std::uint64_t, std::vector<double>> times;
        BenchmarkRow row;
        row.label = method.id + ", " + std::to_string(samples) + " samples";
        double warm_ms = 0;
        for (int i = 0; i <= repeats_ && warm_ms < enough_ms; ++i) {
            at(method.id, i, repeats_);
            execution.restart();
            double ms = 0;
            for (auto next = std::uint64_t{1}; execution.samples() < samples; next *= sample_growth) {
                auto options = options_;
                options.rebuild = execution.samples() == 0;
                const auto frame =
                    execution.run_frame(options, std::min(next, samples) - execution.samples());
                ms += frame.wall_ms;
                if (i > 0)
                    times[execution.samples()].push_back(ms);
                else
                    row.cold_wall_ms = ms;
                row.memory_bytes = frame.memory_bytes;
                if (i == 1) add_point(execution);
            }
            if (i > 0) warm_ms += ms;
        }
        for (auto* region : {&flat_, &all_})
            for (auto& point : region->convergence) point.ms = median(times.at(point.samples));
        row.warm_ms = all_.convergence.back().ms;
        add(std::move(row), picture_of(execution));
    }

    void add_point(const Execution& execution) {
        const auto picture = picture_of(execution);
        for (auto* region : {&flat_, &all_}) {
            const double error = judge(picture, *region, {"rmse"}).at("rmse");
            region->convergence.push_back({execution.samples(), 0, squared_error(error, *region)});
        }
    }

    void add_method(const MethodDescription& method) {
        BenchmarkRow row;
        row.label = method.id;
        const auto fail = [&](const std::string& why) {
            BenchmarkRow failed;
            failed.label = row.label;
            failed.problem = why;
            failed.cells.resize(report_.columns.size());
            report_.rows.push_back(std::move(failed));
        };
        try {
            measure(method, std::move(row));
        } catch (const std::bad_alloc&) {
            fail("out of memory");
        } catch (const Error& error) {
            if (machine_.context().is_lost()) throw;
            fail(error.what());
        }
    }

    void measure(const MethodDescription& method, BenchmarkRow row) {
        Execution execution(machine_, experiment(method, {}));
        std::vector<double> times;
        double warm_ms = 0;
        for (int i = 0; i <= repeats_ && warm_ms < enough_ms; ++i) {
            at(method.id, i, repeats_);
            execution.restart();
            auto options = options_;
            options.rebuild = true;
            const auto frame = execution.run_frame(options);
            if (i > 0) {
                times.push_back(frame.wall_ms);
                warm_ms += frame.wall_ms;
            } else {
                row.cold_wall_ms = frame.wall_ms;
            }
            row.memory_bytes = frame.memory_bytes;
        }
        row.warm_ms = median(times);
        add(std::move(row), picture_of(execution));
    }

    void add(BenchmarkRow row, const BenchmarkPicture& picture) {
        row.cells.resize(report_.columns.size());
        row.cells[time] = row.warm_ms;
        const double flat_time = fill(row, picture, flat_, {flat_rmse, flat_flip, flat_ratio, flat_ms});
        fill(row, picture, all_, {rmse, flip, mean_ratio, ms});
        if (!std::isnan(flat_time)) row.cells[flat_gain] = flat_time / row.warm_ms;
        report_.rows.push_back(std::move(row));
    }

    /// Columns of RMSE, FLIP, mean and time; returns the latter, NaN where nothing could be compared.
    double fill(BenchmarkRow& row, const BenchmarkPicture& picture, const Region& region,
                const std::array<ColumnIndex, 4>& columns) const {
        const std::string flip_metric = is_light() ? "hdr-flip" : "flip";
        const auto measured = judge(picture, region, {"rmse", flip_metric, "mean", "reference-mean"});
        const double squared = squared_error(measured.at("rmse"), region);
        const double numbers[]{std::isnan(squared) ? squared : std::sqrt(std::max(squared, 0.0)),
                               measured.at(flip_metric), measured.at("mean") / measured.at("reference-mean"),
                               std::isnan(squared) ? squared : ms_to_error(region.convergence, squared)};
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (!std::isnan(numbers[i])) row.cells[columns[i]] = numbers[i];
        return numbers[3];
    }

    Machine& machine_;
    const Experiment place_;
    const Question& question_;
    const int repeats_;
    const Tell tell_;
    const Semantic semantic_;
    graph::FrameOptions options_;
    BenchmarkReport report_;
    BenchmarkPicture truth_;
    Region flat_, all_;
};

/// What each row of a table is of the whole work, roughly, in pictures of ambient occlusion by the reference.
std::vector<double> work_of(const Question& question) {
    const bool is_light = semantic_of(reference_method(), question.values) != Semantic::accessibility;
    const double picture = is_light ? 20 : 1;
    std::vector<double> work{truth_frames * picture, 2 * picture};
    work.resize(work.size() + question.methods.size(), 10);
    return work;
}

/// Tells what is done of all rows.
class Teller {
  public:
    Teller(const std::vector<Question>& questions, const BenchmarkCallbacks& callbacks)
        : callbacks_(callbacks) {
        for (const auto& question : questions)
            for (const double work : work_of(question)) work_.push_back(work);
        progress_.rows = work_.size();
    }

    void tell(const std::string& label, int repeat, int repeats, const std::string& what, double fraction) {
        if (has_begun_ && label != progress_.label) ++progress_.row;
        has_begun_ = true;
        progress_.label = label;
        progress_.repeat = repeat;
        progress_.repeats = repeats;
        progress_.what = what;
        const auto row = work_.begin() + static_cast<std::ptrdiff_t>(progress_.row);
        const double part = (repeat + std::clamp(fraction, 0.0, 1.0)) / (repeats + 1);
        progress_.fraction = (std::accumulate(work_.begin(), row, 0.0) + part * *row) /
                             std::accumulate(work_.begin(), work_.end(), 0.0);
        if (callbacks_.progress) callbacks_.progress(progress_);
    }

  private:
    const BenchmarkCallbacks& callbacks_;
    std::vector<double> work_;
    BenchmarkProgress progress_;
    bool has_begun_ = false;
};

}  // namespace

std::vector<BenchmarkReport> run_defaults_benchmark(Machine& machine, const BenchmarkOptions& options,
                                                    const BenchmarkCallbacks& callbacks) {
    const auto requested = questions(options.variants);
    const auto place = place_of(options, {400, 300});
    machine.scenes().load(place.composition());
    Teller teller(requested, callbacks);
    const auto tell = [&](const auto&... what) { teller.tell(what...); };
    const auto& device = machine.context().info();
    std::vector<BenchmarkReport> reports;
    for (const auto& question : requested) {
        const auto date = projects::utc_now();
        auto report = QuestionRun(machine, place, question, options.repeats, callbacks, tell).carry_out();
        report.device = device.renderer;
        report.software = device.software;
        report.repeats = options.repeats;
        report.date = date;
        report.scene = name_of_scene(place);
        report.width = place.width;
        report.height = place.height;
        reports.push_back(std::move(report));
        if (callbacks.report) callbacks.report(reports.back());
    }
    return reports;
}

}  // namespace ir::engine
