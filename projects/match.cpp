#include "projects/match.h"

#include <algorithm>
#include <cmath>

#include "projects/document.h"
#include "projects/motion.h"
#include "projects/names.h"
#include "projects/results.h"
#include "projects/samples.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/light_use.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

/// A matched reference shows a first picture soon and is complete after so many times the method's default.
constexpr int progressive_frames = 16;

/// Seconds.
constexpr double same_moment = 1e-9;

const MethodDescription& reference_method(const Registry& registry) {
    if (const auto* method = registry.reference()) return *method;
    throw UsageError("this build has no method that is the ground truth");
}

/// The transport of a method with these values, complete: its defaults may be others than the reference's.
Settings transport_of(const MethodDescription& method, const Settings& values) {
    Settings transport;
    for (const auto& parameter : method.parameters)
        if (is_transport_key(parameter.key) && holds(parameter.active_when, values))
            transport[parameter.key] = values.at(parameter.key);
    return transport;
}

Settings matched_values(const Settings& transport, const MethodDescription& reference) {
    auto values = defaults(reference.parameters);
    for (const auto& [key, value] : transport) {
        const auto* parameter = find(reference.parameters, key);
        if (!parameter) continue;
        try {
            values[key] = parameter->checked(value);
        } catch (const UsageError& error) {
            throw UsageError("the reference cannot compute this transport: " + std::string(error.what()));
        }
    }
    // What does not count must not tell two experiments apart.
    for (const auto& parameter : reference.parameters)
        if (!holds(parameter.active_when, values)) values[parameter.key] = parameter.default_value;
    return values;
}

/// What makes it the truth that it is, whatever its noise.
Json truth_of(const Project& project, const Experiment& experiment, const Registry& registry, bool moves) {
    auto inputs = state_inputs(project, experiment, registry);
    inputs.erase("seed");
    if (!moves) inputs.erase("time");
    return inputs;
}

/// An experiment that is the same truth; the one that `experiment` has already before all others.
const Experiment* find_match(const Project& project, const Experiment& experiment, const Experiment& truth,
                             const Registry& registry, const AnimatedScene& is_animated) {
    const bool moves = is_moving(project, experiment, is_animated);
    const auto wanted = truth_of(project, truth, registry, moves);
    const Experiment* found = nullptr;
    for (const auto& candidate : project.experiments) {
        if (candidate.method != truth.method || truth_of(project, candidate, registry, moves) != wanted)
            continue;
        if (!found || candidate.id == experiment.reference) found = &candidate;
    }
    return found;
}

std::string shown(const Value& value) {
    return ir::to_string(value);
}

/// To the millisecond.
std::string shown_seconds(double seconds) {
    return ir::to_string(std::round(1000 * seconds) / 1000);
}

/// Light that is in one of two pictures alone, of the first few sources; empty: none. The sources are asked
/// for only where the two use them differently.
std::string differing_light(const MethodDescription& method, const Settings& values,
                            const MethodDescription& reference, const Settings& its_values,
                            const std::function<std::vector<LightSource>()>& sources) {
    constexpr std::size_t most = 3;
    const auto mine = light_use(method, values), its = light_use(reference, its_values);
    if (mine.differing_kinds(its) == 0) return {};
    const auto all = sources();
    const auto found = light_differences(used_lights(all, mine), used_lights(all, its),
                                         parts_in_both(values, its_values), "the picture", "the reference");
    std::string text;
    for (std::size_t i = 0; i < std::min(found.size(), most); ++i) text += (i > 0 ? "; " : "") + found[i];
    if (found.size() > most) text += "; and " + std::to_string(found.size() - most) + " more sources";
    return text;
}

/// In what two experiments differ that makes one no truth of the other; empty: in nothing.
std::string mismatch(const Project& project, const Experiment& experiment, const Experiment& truth,
                     const Registry& registry, const SceneFacts& facts) {
    std::vector<std::string> found;
    const double seconds = last_time(experiment, registry), truth_seconds = last_time(truth, registry);
    const auto mine = moment_inputs(project, experiment, seconds);
    const auto its = moment_inputs(project, truth, truth_seconds);
    for (const char* key : {"scene", "camera", "lights", "environment", "size"})
        if (mine.at(key) != its.at(key)) found.push_back(key);
    if (mine.contains("light_motion") != its.contains("light_motion") ||
        (mine.contains("light_motion") && mine.at("light_motion") != its.at("light_motion")))
        found.push_back("motions of lights");
    if (std::abs(seconds - truth_seconds) > same_moment && is_moving(project, experiment, facts.is_animated))
        found.push_back("time (" + shown_seconds(seconds) + " s after its last frame, the reference has " +
                        shown_seconds(truth_seconds) + " s)");
    const auto* method = registry.find(experiment.method);
    const auto* reference = registry.find(truth.method);
    if (method && reference) {
        const auto mine = runnable_settings(experiment, *method),
                   values = runnable_settings(truth, *reference);
        for (const auto& [key, value] : transport_of(*method, mine)) {
            const auto other = values.find(key);
            if (!chooses_sources(key) && other != values.end() && other->second != value)
                found.push_back(key + " (" + shown(value) + ", the reference has " + shown(other->second) +
                                ")");
        }
        const auto light = differing_light(*method, mine, *reference, values, [&] {
            const auto known = facts.light_sources(experiment);
            return known.empty() ? facts.light_sources(truth) : known;
        });
        if (!light.empty()) found.push_back("light (" + light + ")");
    }
    return listed(found);
}

}  // namespace

bool is_moving(const Project& project, const Experiment& experiment, const AnimatedScene& is_animated) {
    const auto run = effective(experiment);
    const auto motions = motions_of(project, run);
    return std::any_of(motions.begin(), motions.end(),
                       [](const Motion* motion) { return is_moving(*motion); }) ||
           is_animated(run.scene);
}

Settings matching_values(const MethodDescription& method, const Settings& values, const Registry& registry) {
    const auto& reference = reference_method(registry);
    if (method.is_reference) throw UsageError("'" + method.id + "' is the reference itself");
    const auto all = completed(method.parameters, values);
    return with_light_use(reference, matched_values(transport_of(method, all), reference),
                          light_use(method, all));
}

Experiment ground_truth(Experiment run, const Registry& registry) {
    run.values = matching_values(registry.at(run.method), run.values, registry);
    run.time = last_time(run, registry);
    run.method = reference_method(registry).id;
    run.shaders.clear();
    run.frames = progressive_frames;
    return run;
}

Experiment matching_reference(const Project& project, const Experiment& experiment, const Registry& registry,
                              const AnimatedScene& is_animated) {
    const auto& reference = reference_method(registry);
    const auto* method = registry.find(experiment.method);
    if (!method)
        throw UsageError("this build has no method '" + printable(experiment.method, 60) +
                         "', so its transport is unknown");
    if (method->is_reference)
        throw UsageError("'" + printable(experiment.id, 60) + "' is a reference itself");
    auto run = effective(experiment);
    run.values = runnable_settings(experiment, *method);
    const auto computed = ground_truth(run, registry);
    auto truth = edits::new_experiment(project, registry, reference.id, "", run.scene, run.camera);
    truth.id = free_experiment_id(project, reference_name(experiment.id));
    truth.name = free_name(project, reference_name(experiment.name));
    truth.lights = run.lights;
    truth.size = run.size;
    truth.time = is_moving(project, experiment, is_animated) ? computed.time : run.time;
    truth.frames = computed.frames;
    truth.values = computed.values;
    return truth;
}

EditPtr match(const Project& project, const std::string& id, const Registry& registry,
              const AnimatedScene& is_animated) {
    const auto& experiment = experiment_of(project, id);
    const auto truth = matching_reference(project, experiment, registry, is_animated);
    const auto label = "Match '" + printable(experiment.name, 40) + "' with its reference";
    std::vector<EditPtr> steps;
    if (const auto* found = find_match(project, experiment, truth, registry, is_animated)) {
        if (found->id == experiment.reference) return nullptr;
        steps.push_back(edits::set_reference(project, id, found->id));
        return edits::group(label, std::move(steps));
    }
    const auto behind = static_cast<std::size_t>(&experiment - project.experiments.data()) + 1;
    steps.push_back(edits::add(project, truth, behind));
    auto with_truth = project;
    steps.back()->apply(with_truth);
    steps.push_back(edits::set_reference(with_truth, id, truth.id));
    return edits::group(label, std::move(steps));
}

std::vector<std::pair<std::string, std::string>> mismatched_references(const Project& project,
                                                                       const Registry& registry,
                                                                       const SceneFacts& facts) {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& experiment : project.experiments) {
        const auto* truth = find_item(project.experiments, experiment.reference);
        if (!truth) continue;
        const auto why = mismatch(project, experiment, *truth, registry, facts);
        if (!why.empty())
            result.emplace_back(experiment.id, "is judged by '" + truth->id + "', which differs in " + why);
    }
    return result;
}

}  // namespace ir::projects
