#include "app/engine/study_reference.h"

#include <cmath>

#include "app/engine/from_project.h"
#include "app/engine/keep_result.h"
#include "app/engine/pictures.h"
#include "app/engine/run_frames.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "renderers/image/channels.h"

namespace ir::engine {
namespace {

/// Key of the output that holds the variance; empty where the method has none.
std::string variance_key(const projects::Experiment& experiment) {
    const auto* method = registry().find(experiment.method);
    return method ? method->variance : std::string();
}

StudyReference from_image(const projects::ForeignImage& image, const std::filesystem::path& folder) {
    StudyReference result;
    result.image = read_image(projects::resolve(image.source, folder));
    result.notes.push_back("the reference is a foreign image: nothing says what light transport it shows");
    return result;
}

StudyReference rendered(Machine& machine, const projects::Project& project,
                        const projects::Experiment& experiment, const std::filesystem::path& folder,
                        graph::FrameOptions options, bool keeps) {
    const auto key = variance_key(experiment);
    if (!key.empty()) options.wanted.push_back(key);
    Execution execution(machine, from_project(project, experiment, folder));
    StudyReference result;
    result.notes = resume_kept(execution, project, experiment, folder);
    if (execution.samples() > 0)
        result.notes.push_back("the reference goes on from a kept state of " +
                               std::to_string(execution.samples()) + " samples");
    if (const auto progress = options.progress)
        options.progress = [progress](const std::string& what, double part) {
            progress("Reference: " + what, part);
        };
    Checkpoints checkpoints;
    if (keeps && execution.accumulates())
        checkpoints.keep = [&](const FrameReport& report) {
            keep_result(project, experiment, folder, execution, report);
        };
    const auto report = run_frames(execution, options, checkpoints);
    try {
        if (checkpoints.keep) checkpoints.keep(report);
    } catch (const Error& error) {
        result.notes.push_back(std::string("the reference was not kept: ") + error.what());
    }
    result.image = main_result(execution);
    result.attributes = attributes(execution);
    result.valid = execution.graph().read_image("valid").value_or(Image());
    const auto variance = key.empty() ? std::nullopt : execution.graph().read_image(key);
    if (variance) result.noise = noise_of(*variance, result.valid);
    return result;
}

}  // namespace

std::optional<StudyReference> kept_picture(const projects::Project& now,
                                           const projects::Experiment& experiment,
                                           const std::filesystem::path& folder) {
    const auto index = projects::ResultIndex::load(folder);
    const auto* kept = index.find(projects::result_key(now, experiment, registry()));
    if (!kept) return {};
    StudyReference result;
    Image variance;
    for (const auto& file : kept->files) {
        if (file.role != projects::main_role) continue;
        for (auto& layer : read_exr(folder / "results" / file.path, &result.attributes)) {
            if (layer.name.empty()) result.image = std::move(layer.image);
            if (layer.name == "valid") result.valid = std::move(layer.image);
            if (!layer.name.empty() && layer.name == variance_key(experiment))
                variance = std::move(layer.image);
        }
    }
    if (result.image.empty()) return {};
    result.kept_on = kept->provenance.date;
    if (!variance.empty()) result.noise = noise_of(variance, result.valid);
    return result;
}

double noise_of(const Image& variance, const Image& valid) {
    const int channels = value_channels(Semantic::radiance, variance.channels);
    double sum = 0;
    std::size_t count = 0;
    for (int y = 0; y < variance.height; ++y)
        for (int x = 0; x < variance.width; ++x) {
            if (!valid.empty() && !(valid.at(x, y) > 0.5f)) continue;
            for (int c = 0; c < channels; ++c) {
                const double value = variance.at(x, y, c);
                if (!std::isfinite(value)) continue;
                sum += value;
                ++count;
            }
        }
    return count == 0 ? 0 : std::sqrt(sum / static_cast<double>(count));
}

StudyReference study_reference(Machine& machine, const projects::Project& project, const std::string& id,
                               const std::filesystem::path& folder, const graph::FrameOptions& options,
                               bool keeps) {
    if (const auto* image = find_item(project.images, id)) return from_image(*image, folder);
    const auto* experiment = find_item(project.experiments, id);
    if (!experiment) throw UsageError("there is no experiment or image '" + id + "' to be the reference");
    std::string why_not_kept;
    try {
        const auto now = projects::with_contents(project, projects::read_contents(project, folder));
        if (auto kept = kept_picture(now, *experiment, folder)) {
            kept->notes.push_back("the reference is its kept result of " + kept->kept_on);
            return std::move(*kept);
        }
    } catch (const InputError& error) {
        why_not_kept = std::string("the reference was rendered, because its kept result cannot be read: ") +
                       error.what();
    }
    auto result = rendered(machine, project, *experiment, folder, options, keeps);
    if (!why_not_kept.empty()) result.notes.push_back(why_not_kept);
    return result;
}

}  // namespace ir::engine
