#include "projects/samples.h"

#include <algorithm>

#include "projects/edit_kinds.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

const ParameterDescription* accumulating_parameter(const MethodDescription& method) {
    for (const auto& parameter : method.parameters)
        if (parameter.accumulates) return &parameter;
    return nullptr;
}

std::uint64_t count_of(const Value& value) {
    const auto* number = std::get_if<std::int64_t>(&value);
    return number && *number > 0 ? static_cast<std::uint64_t>(*number) : 1;
}

/// The number of samples in a frame that is nearest to `per_frame` and divides `samples`, within a factor of
/// 4; else all in one frame.
std::uint64_t even_share(std::uint64_t samples, std::uint64_t per_frame) {
    for (std::uint64_t distance = 0; distance <= 3 * per_frame; ++distance) {
        if (samples % (per_frame + distance) == 0) return per_frame + distance;
        const bool is_near = 4 * (per_frame - std::min(per_frame, distance)) >= per_frame;
        if (is_near && samples % (per_frame - distance) == 0) return per_frame - distance;
    }
    return samples;
}

}  // namespace

bool accumulates(const MethodDescription& method) {
    return accumulating_parameter(method) != nullptr;
}

double last_time(const Experiment& experiment, const Registry& registry) {
    const auto run = effective(experiment);
    const auto* method = registry.find(run.method);
    return !method || accumulates(*method) ? run.time : run.time + (run.frames - 1) * frame_seconds;
}

std::uint64_t samples_per_frame(const MethodDescription& method, const Settings& values) {
    std::uint64_t product = 1;
    for (const auto& parameter : method.parameters) {
        if (!parameter.accumulates) continue;
        const auto given = values.find(parameter.key);
        product *= count_of(given == values.end() ? parameter.default_value : given->second);
    }
    return product;
}

std::uint64_t sample_count(const Experiment& experiment, const Registry& registry) {
    const auto run = effective(experiment);
    const auto frames = static_cast<std::uint64_t>(std::max(1, run.frames));
    const auto* method = registry.find(run.method);
    return method ? frames * samples_per_frame(*method, run.values) : frames;
}

Experiment with_sample_count(const Experiment& experiment, std::uint64_t samples, const Registry& registry) {
    const auto* method = registry.find(experiment.method);
    const auto* parameter = method ? accumulating_parameter(*method) : nullptr;
    if (!parameter || samples == 0 || sample_count(experiment, registry) == samples) return experiment;
    Experiment after = experiment;
    const auto run = effective(experiment);
    const auto given = run.values.find(parameter->key);
    const auto now = count_of(given == run.values.end() ? parameter->default_value : given->second);
    const auto others = std::max<std::uint64_t>(1, samples_per_frame(*method, run.values) / now);
    const auto wanted = (samples + others - 1) / others;
    auto share = even_share(wanted, now);
    // A parameter may have an upper end, and so have frames.
    const auto most = static_cast<std::uint64_t>(std::clamp(parameter->hard.max, 1.0, 1e15));
    share = std::min(std::max(share, (wanted + max_frames - 1) / max_frames), most);
    const auto frames = std::min<std::uint64_t>((wanted + share - 1) / share, max_frames);
    const auto preset = after.presets.find(after.active_preset);
    auto* chosen = preset == after.presets.end() ? nullptr : &preset->second;
    auto& values = chosen && chosen->values.count(parameter->key) ? chosen->values : after.values;
    values[parameter->key] = static_cast<std::int64_t>(share);
    if (chosen && chosen->frames)
        chosen->frames = static_cast<int>(frames);
    else
        after.frames = static_cast<int>(frames);
    return after;
}

EditPtr set_sample_count(const Project& project, const std::string& experiment, std::uint64_t samples,
                         const Registry& registry) {
    const auto after = with_sample_count(edits::item_of<Experiment>(project, experiment), samples, registry);
    return edits::replace(project, after, "Change number of samples", "samples:" + experiment);
}

}  // namespace ir::projects
