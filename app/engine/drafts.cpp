#include "app/engine/drafts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "app/engine/camera_pose.h"
#include "app/engine/live_session.h"
#include "app/engine/moving.h"
#include "app/engine/pictures.h"
#include "renderers/image/enlarge.h"
#include "renderers/passes/preview/preview.h"

namespace ir::engine {
namespace {

using Clock = std::chrono::steady_clock;

/// Memory that drafts may hold while the full picture is looked at.
constexpr std::uint64_t max_kept_bytes = std::uint64_t{256} << 20;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

int divisor_of(Fineness fineness) {
    return fineness == Fineness::quarter ? 4 : fineness == Fineness::half ? 2 : 1;
}

Experiment preview_of(Experiment experiment) {
    experiment.method = passes::preview().description.id;
    experiment.settings.clear();
    experiment.shaders.clear();
    experiment.frames = 1;
    return experiment;
}

Experiment coarse_of(Experiment experiment, Fineness fineness) {
    const int divisor = divisor_of(fineness);
    experiment.width = (experiment.width + divisor - 1) / divisor;
    experiment.height = (experiment.height + divisor - 1) / divisor;
    experiment.frames = 1;
    const auto& parameters = registry().at(experiment.method).parameters;
    experiment.settings = coarse(parameters, completed(parameters, experiment.settings));
    return experiment;
}

/// All that decides what surfaces a picture shows where.
std::string sight_of(const Experiment& experiment) {
    std::ostringstream text;
    text << std::hexfloat << experiment.camera_name << ' ' << experiment.time << ' '
         << motion_text(experiment);
    if (const auto& camera = experiment.camera)
        std::apply([&](auto... numbers) { ((text << ' ' << numbers), ...); }, seen_by(*camera));
    return text.str();
}

/// The key of an experiment's main result; empty: none.
std::string main_key_of(const Experiment& experiment) {
    const auto& method = registry().at(experiment.method);
    const auto* output = main_output(method, completed(method.parameters, experiment.settings));
    return output ? output->key : std::string();
}

/// Images of the coarse view's size become those of the full one; others are left out.
void enlarge(LiveResult& result, const Experiment& coarse, const Experiment& full) {
    const auto has_view_size = [&](const Image& image) {
        return image.width == coarse.width && image.height == coarse.height;
    };
    std::erase_if(result.images, [&](const auto& each) { return !has_view_size(each.second); });
    if (!has_view_size(result.valid)) result.valid = {};
    if (coarse.width == full.width && coarse.height == full.height) return;
    for (auto& [part, image] : result.images) image = enlarged(image, full.width, full.height);
    if (!result.valid.empty()) result.valid = enlarged(result.valid, full.width, full.height);
}

}  // namespace

void Drafts::compile_preview(Machine& machine) {
    Experiment experiment;
    experiment.scene = "builtin:plane";
    experiment.width = experiment.height = 8;
    try {
        Execution(machine, preview_of(experiment)).run_frame({});
    } catch (const std::exception&) {
        // The first picture that is asked for says what is wrong.
    }
}

/// What was built in the frame and stands still in the next does not count.
double Drafts::steady_ms(const FrameReport& report, double ms) {
    for (const auto& pass : report.passes)
        if (pass.is_kept && pass.slices > 0) ms -= pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms;
    return std::max(0.0, ms);
}

void Drafts::begin(const Experiment& experiment) {
    const Subject subject{experiment.method, experiment.composition(), experiment.width, experiment.height};
    const auto sight = sight_of(experiment);
    const bool is_seen_already = subject == subject_ && sight == seen_;
    if (subject != subject_) {
        choice_.forget();
        coarse_was_ = Fineness::full;
    }
    subject_ = subject;
    seen_ = sight;
    next_ = choice_.first(is_seen_already);
}

Execution& Drafts::execution_for(std::unique_ptr<Execution>& execution, Experiment experiment) {
    if (!execution)
        execution = std::make_unique<Execution>(machine_, std::move(experiment), shared_);
    else if (!execution->update(std::move(experiment)))
        execution->restart();
    return *execution;
}

LiveResult Drafts::render(Fineness fineness, const LiveRequest& request, graph::FrameOptions options) {
    const bool is_preview = fineness == Fineness::preview;
    // However slow the machine is, a hand that never rests sees something.
    if (is_preview) options.cancel = nullptr;
    const auto experiment =
        is_preview ? preview_of(request.experiment) : coarse_of(request.experiment, fineness);
    auto& execution = execution_for(is_preview ? preview_ : coarse_, experiment);
    const auto main = main_key_of(request.experiment);
    LiveRequest looks;
    for (const auto& part : request.parts) {
        const bool is_main = part.key.empty() || part.key == main;
        if (part.level != 0 || part.layer < 0 || !part.after.empty() || (is_preview && !is_main)) continue;
        looks.parts.push_back(is_preview ? Part{} : part);
        if (!is_preview && !part.key.empty()) options.wanted.push_back(part.key);
    }
    LiveResult result;
    result.tag = request.tag;
    result.frames = request.experiment.frames;
    result.report = execution.run_frame(options);
    result.time = execution.time();
    result.camera = execution.camera();
    result.fineness = fineness;
    read_back(result, looks, execution);
    enlarge(result, experiment, request.experiment);
    if (is_preview)
        for (const auto& part : request.parts)
            if (part.key == main && part.level == 0 && part.layer == 0 && result.images.count(Part{}))
                result.images[part] = result.images.at(Part{});
    return result;
}

std::optional<LiveResult> Drafts::render(const LiveRequest& request, const graph::FrameOptions& options) {
    while (next_ < Fineness::full) {
        const auto fineness = next_;
        const bool is_preview = fineness == Fineness::preview;
        const bool is_first = !(is_preview ? preview_ : coarse_);
        // What is kept and was built again, though only the camera moved, is built for each picture.
        const bool is_moved_only = !is_first && (is_preview || coarse_was_ == fineness);
        const auto start = Clock::now();
        try {
            auto result = render(fineness, request, options);
            const double wall_ms = ms_since(start);
            const double ms = is_moved_only ? wall_ms : steady_ms(result.report, wall_ms);
            if (is_first)
                choice_.note_first(fineness, ms);
            else
                choice_.note(fineness, ms);
            if (!is_preview) coarse_was_ = fineness;
            next_ = choice_.after(fineness);
            result.drafts_left = next_ < Fineness::full;
            return result;
        } catch (const Cancelled&) {
            // So long at least; where that is too much, the next one begins coarser.
            choice_.note_given_up(fineness, ms_since(start));
            throw;
        } catch (const std::exception&) {
            next_ = choice_.after(fineness);
        }
    }
    return {};
}

std::uint64_t Drafts::bytes() const {
    std::uint64_t bytes = 0;
    for (const auto* execution : {preview_.get(), coarse_.get()})
        if (execution) bytes += execution->graph().last_report().memory_bytes;
    return bytes;
}

void Drafts::rest(std::uint64_t left_over) {
    if (bytes() > std::min(max_kept_bytes, left_over)) free();
}

void Drafts::free() {
    preview_.reset();
    coarse_.reset();
}

}  // namespace ir::engine
