#include "app/engine/sweep_run.h"

#include <algorithm>
#include <charconv>
#include <chrono>

#include "app/engine/from_project.h"
#include "app/engine/measure.h"
#include "app/engine/median.h"
#include "app/engine/moving.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "app/engine/version.h"
#include "projects/results.h"
#include "projects/samples.h"
#include "projects/scene_files.h"
#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_problem = 4096;
/// Ground truths that are held: an axis may alternate between cameras, but not between a thousand.
constexpr std::size_t max_references = 8;

const std::string noise_attribute = attribute_prefix + "noise";

void store_reference(const fs::path& file, const StudyReference& reference) {
    std::vector<ImageLayer> layers{{"", standard_channels(reference.image.channels), Image(reference.image)}};
    if (!reference.valid.empty())
        layers.push_back({"valid", standard_channels(reference.valid.channels), Image(reference.valid)});
    real_file_system().create_directories(file.parent_path());
    auto attributes = reference.attributes;
    attributes[noise_attribute] = to_string(Value{reference.noise});
    write_exr(file, layers, attributes);
}

/// Nothing where none is there.
std::optional<StudyReference> load_reference(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return {};
    StudyReference reference;
    for (auto& layer : read_exr(file, &reference.attributes))
        (layer.name.empty() ? reference.image : reference.valid) = std::move(layer.image);
    const auto& noise = reference.attributes[noise_attribute];
    std::from_chars(noise.data(), noise.data() + noise.size(), reference.noise);
    return reference;
}

}  // namespace

SweepRun::SweepRun(Machine& machine, const projects::Project& project, fs::path folder, SweepOptions options)
    : machine_(machine),
      project_(project),
      now_(projects::with_contents(project, projects::read_contents(project, folder))),
      folder_(std::move(folder)),
      options_(std::move(options)),
      facts_(scene_facts(machine.scenes(), now_, folder_)),
      frame_(options_.frame) {
    if (options_.frame.progress)
        frame_.progress = [this](const std::string& what, double part) {
            options_.frame.progress(what, std::min(1.0, (step_ + part) / steps_));
        };
}

projects::Experiment SweepRun::ground_truth(const projects::SweepPoint& point) const {
    auto truth = projects::matching_reference(now_, point.experiment, registry(), facts_.is_animated);
    if (options_.samples > 0) truth = projects::with_sample_count(truth, options_.samples, registry());
    truth.id = projects::free_id_in(project_.experiments, "ground-truth");
    return truth;
}

SweepRow SweepRun::planned(const projects::SweepPoint& point) const {
    SweepRow row;
    row.id = point.experiment.id;
    row.coordinates = point.coordinates;
    row.key = projects::result_key(now_, point.experiment, registry());
    if (!options_.is_judged) return row;
    try {
        row.reference = projects::result_key(now_, ground_truth(point), registry());
    } catch (const Error& error) {
        row.problem = projects::printable(error.what(), longest_problem);
    }
    return row;
}

void SweepRun::render(const projects::SweepPoint& point, SweepRow& row, const Pictured& pictured,
                      bool& was_refused) {
    auto rendered = row;
    try {
        complete(point, rendered, pictured);
        rendered.problem.clear();
        row = std::move(rendered);
    } catch (const Error& error) {
        if (machine_.context().is_lost()) throw;
        row.problem = projects::printable(error.what(), longest_problem);
        was_refused = is_refusal(error);
    }
}

void SweepRun::complete(const projects::SweepPoint& point, SweepRow& row, const Pictured& pictured) {
    step_ = 0;
    steps_ = 1 + options_.repeats;
    const StudyReference* reference = nullptr;
    if (options_.is_judged) {
        if (references_.count(row.reference) == 0) ++steps_;
        reference = &reference_of(point, row.reference);
    }
    Execution execution(machine_, from_project(project_, point.experiment, folder_));
    const auto report = run(execution);
    row.cold_ms = report.wall_ms;
    row.memory_bytes = report.memory_bytes;
    row.counters = report.counters;
    row.device = report.device;
    row.build = version_and_commit();
    if (reference) {
        machine_.context().make_current();
        auto measured = measure(execution, *reference, options_.frame.cancel);
        row.errors = std::move(measured.errors);
        row.pixels = measured.pixels;
        row.skipped = measured.skipped;
        row.reference_noise = reference->noise;
    }
    row.image = pictured(execution, report);
    if (options_.repeats > 0) row.warm_ms = warm_ms(execution);
}

const StudyReference& SweepRun::reference_of(const projects::SweepPoint& point, const std::string& key) {
    if (const auto known = references_.find(key); known != references_.end()) return known->second;
    if (references_.size() >= max_references) references_.clear();
    const auto file = options_.references.empty() ? fs::path() : options_.references / (key + ".exr");
    std::optional<StudyReference> found;
    try {
        if (!file.empty()) found = load_reference(file);
    } catch (const InputError& error) {
        if (options_.note) options_.note(std::string("the ground truth is rendered again: ") + error.what());
    }
    const auto start = std::chrono::steady_clock::now();
    if (!found) {
        found = rendered_reference(point);
        for (const auto& note : found->notes)
            if (options_.note) options_.note(note);
        if (!file.empty()) store_reference(file, *found);
        reference_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    ++step_;
    return references_[key] = std::move(*found);
}

StudyReference SweepRun::rendered_reference(const projects::SweepPoint& point) {
    auto project = project_;
    const auto truth = ground_truth(point);
    project.experiments.push_back(truth);
    return study_reference(machine_, project, truth.id, folder_, frame_);
}

FrameReport SweepRun::run(Execution& execution) {
    auto report = run_frames(execution, frame_);
    ++step_;
    return report;
}

double SweepRun::warm_ms(Execution& execution) {
    std::vector<double> times;
    // A buffer that grew is large enough in the next run; the time of this one says nothing.
    for (int attempt = 0; int(times.size()) < options_.repeats; ++attempt) {
        execution.restart();
        const auto report = run(execution);
        const auto growth = report.counters.find("growth");
        const bool grew = growth != report.counters.end() && growth->second > 0;
        if (!grew || attempt > options_.repeats) times.push_back(report.wall_ms);
    }
    return median(times);
}

}  // namespace ir::engine
