#include "app/engine/analysis/analysis_run.h"

#include <algorithm>
#include <cmath>

#include "app/engine/from_project.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "app/engine/study_reference.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/graph/shared_contents.h"
#include "renderers/image/channels.h"
#include "renderers/image/metrics.h"
#include "renderers/plot/plot_scale.h"

namespace ir::engine {
namespace {

std::string size_text(int width, int height, int channels) {
    return std::to_string(width) + "×" + std::to_string(height) + " pixels of " + std::to_string(channels) +
           (channels == 1 ? " channel" : " channels");
}

}  // namespace

AnalysisRun::AnalysisRun(Machine& machine, const projects::Project& project,
                         const projects::Analysis& analysis, const std::filesystem::path& folder,
                         const AnalysisCallbacks& callbacks)
    : machine_(machine),
      project_(project),
      analysis_(analysis),
      folder_(folder),
      callbacks_(callbacks),
      now_(projects::with_contents(project, projects::read_contents(project, folder))),
      shared_(std::make_shared<graph::SharedContents>()) {
    const auto first = experiment(0);
    if (const auto* output = main_output(method(), first.values)) semantic_ = output->semantic;
}

projects::Experiment AnalysisRun::experiment(std::size_t index) const {
    auto run = projects::effective(projects::experiment_of(project_, analysis_.experiments.at(index)));
    run.values = projects::runnable_settings(run, registry().at(run.method));
    return run;
}

const std::string& AnalysisRun::name(std::size_t index) const {
    const auto& item = projects::experiment_of(project_, analysis_.experiments.at(index));
    return item.name.empty() ? item.id : item.name;
}

const MethodDescription& AnalysisRun::method() const {
    return registry().at(projects::experiment_of(project_, analysis_.experiments.front()).method);
}

std::string AnalysisRun::error_title(const std::string& other) const {
    if (!has_reference()) return "RMSE to " + other;
    const auto* experiment = projects::find_item(project_.experiments, analysis_.reference);
    const auto* image = projects::find_item(project_.images, analysis_.reference);
    const auto& name = experiment ? experiment->name : image ? image->name : analysis_.reference;
    return "RMSE to " + (name.empty() ? analysis_.reference : name);
}

void AnalysisRun::tell(const std::string& what, double part) const {
    if (callbacks_.progress)
        callbacks_.progress(
            what, std::min(1.0, (double(done_) + part) / double(std::max<std::size_t>(expected_, 1))));
}

void AnalysisRun::check() const {
    if (callbacks_.cancel) callbacks_.cancel->check();
}

void AnalysisRun::note(const std::string& line) {
    if (std::ranges::find(notes_, line) == notes_.end()) notes_.push_back(line);
}

graph::FrameOptions AnalysisRun::frame_options(std::function<std::string()> what) const {
    graph::FrameOptions options;
    options.cancel = callbacks_.cancel;
    options.memory_budget = callbacks_.memory_budget;
    options.progress = [this, what = std::move(what)](const std::string& pass, double part) {
        tell(what() + ": " + pass, part);
    };
    return options;
}

Image AnalysisRun::picture(const projects::Experiment& experiment, const std::string& what) {
    check();
    tell(what, 0);
    std::optional<StudyReference> kept;
    try {
        kept = kept_picture(now_, experiment, folder_);
    } catch (const InputError& error) {
        note(std::string("a picture was rendered, because its kept result cannot be read: ") + error.what());
    }
    if (!kept) {
        Execution execution(machine_, from_project(project_, experiment, folder_), shared_);
        run_frames(execution, frame_options([&] { return what; }));
        machine_.context().make_current();
        kept.emplace();
        kept->image = main_result(execution);
        kept->valid = execution.graph().read_image("valid").value_or(Image());
    }
    ++done_;
    return values(kept->image, kept->valid, semantic_, "'" + experiment.id + "'");
}

const Image& AnalysisRun::reference() {
    if (!reference_) reference_.emplace();
    if (!has_reference() || !reference_->empty()) return *reference_;
    graph::FrameOptions options;
    options.cancel = callbacks_.cancel;
    options.memory_budget = callbacks_.memory_budget;
    options.progress = [this](const std::string& what, double part) { tell(what, part); };
    auto truth = study_reference(machine_, project_, analysis_.reference, folder_, options);
    machine_.context().make_current();
    for (const auto& line : truth.notes) note(line);
    if (truth.noise > 0)
        note("the reference has an RMSE of about " + plot_number(truth.noise) +
             " left of its own; smaller errors against it say nothing");
    ++done_;
    *reference_ = values(truth.image, truth.valid, semantic_, "the reference");
    return *reference_;
}

Image AnalysisRun::values(const Image& image, const Image& valid, Semantic semantic, const std::string& who) {
    Image storage;
    Image values = values_of(image, semantic, storage);
    semantic_ = semantic;
    if (width_ == 0) {
        width_ = values.width;
        height_ = values.height;
        channels_ = values.channels;
    }
    if (values.width != width_ || values.height != height_ || values.channels != channels_)
        throw UsageError(who + " has " + size_text(values.width, values.height, values.channels) +
                         ", the picture before " + size_text(width_, height_, channels_) +
                         "; give both the same size and paths");
    exclude_invalid(valid);
    return values;
}

void AnalysisRun::exclude(std::size_t pixel) {
    if (valid_.empty()) valid_ = Image(width_, height_, 1, 1);
    valid_.pixels[pixel] = 0;
}

void AnalysisRun::exclude_invalid(const Image& valid) {
    if (valid.width != width_ || valid.height != height_) return;
    for (std::size_t i = 0; i < valid.pixels.size(); i += std::size_t(valid.channels))
        if (!(valid.pixels[i] > 0.5f)) exclude(i / std::size_t(valid.channels));
}

double AnalysisRun::rmse(const Image& a, const Image& b) const {
    const auto* mask = valid_.empty() ? nullptr : &valid_;
    return compute_metrics(a, b, {"rmse"},
                           {.semantic = semantic_, .valid_image = mask, .valid_reference = mask})
        .values.at("rmse");
}

Image AnalysisRun::distance(const Image& a, const Image& b) {
    Image result(width_, height_, 1);
    for (std::size_t pixel = 0; pixel < result.pixels.size(); ++pixel) {
        double sum = 0;
        for (int c = 0; c < channels_; ++c) {
            const auto at = pixel * std::size_t(channels_) + std::size_t(c);
            const double d = double(a.pixels[at]) - double(b.pixels[at]);
            sum += d * d;
        }
        const double length = std::sqrt(sum / channels_);
        if (std::isfinite(length))
            result.pixels[pixel] = float(length);
        else
            exclude(pixel);
    }
    return result;
}

Image AnalysisRun::mean(const Image& image) {
    Image result(image.width, image.height, 1);
    for (std::size_t pixel = 0; pixel < result.pixels.size(); ++pixel) {
        double sum = 0;
        for (int c = 0; c < image.channels; ++c)
            sum += image.pixels[pixel * std::size_t(image.channels) + std::size_t(c)];
        result.pixels[pixel] = float(sum / image.channels);
    }
    return result;
}

std::size_t AnalysisRun::count_valid() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::size_t(width_) * std::size_t(height_); ++i) count += is_valid(i) ? 1 : 0;
    return count;
}

}  // namespace ir::engine
