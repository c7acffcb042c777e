#include <algorithm>
#include <map>

#include "app/engine/analysis/analysis_run.h"
#include "app/engine/analysis/bars.h"
#include "projects/text.h"

namespace ir::engine {
namespace {

const Choice& choice_of(const ParameterDescription& parameter, const std::string& key) {
    return parameter.choices.at(std::size_t(parameter.choice_index(key)));
}

/// Whether a stand-in has a meaning under these settings, and is not what they have already or another way
/// to the same.
bool is_other(const ParameterDescription& parameter, const std::string& stand_in, const Settings& settings) {
    const auto& supported = parameter.supported;
    if (!supported.empty() && std::ranges::find(supported, stand_in) == supported.end()) return false;
    const auto now = std::get<std::string>(settings.at(parameter.key));
    if (now == stand_in || !is_active(parameter, settings)) return false;
    return choice_of(parameter, now).effect == Effect::image ||
           choice_of(parameter, stand_in).effect == Effect::image;
}

}  // namespace

AnalysisResult waterfall(AnalysisRun& run) {
    const auto base = run.experiment(0);
    const auto& wanted = run.analysis().parameters;
    std::vector<const ParameterDescription*> stages;
    std::size_t stand_ins = 0;
    for (const auto& parameter : run.method().parameters) {
        const bool is_wanted = wanted.empty() || std::ranges::find(wanted, parameter.key) != wanted.end();
        if (!is_wanted || parameter.exact.empty()) continue;
        stages.push_back(&parameter);
        stand_ins += parameter.exact.size();
    }
    run.expect(2 + 2 * stand_ins);
    const auto error = run.error_title("");
    const auto& truth = run.reference();
    auto picture = run.picture(base, run.name(0));
    const double first = run.rmse(picture, truth);

    AnalysisResult result;
    Bars bars("Error of " + run.name(0), error,
              {"Stage", "Stand-in", error, "Change", "Of the error", "Alone"});
    const auto part = [&](double change) { return first > 0 ? percent_cell(change / first) : PlotCell{"—"}; };
    bars.begin_row("As it is");
    bars.add("base", 0, first, {{"As it is"}, {""}, number_cell(first), {""}, {""}, {""}});
    result.pictures.push_back(
        {"base", "As it is", "Distance from the reference.", false, {}, run.distance(picture, truth)});
    auto experiment = base;
    double before = first;
    std::vector<std::string> exact_already;
    for (const auto* stage : stages) {
        bool is_put = false;
        for (const auto& stand_in : stage->exact) {
            if (!is_other(*stage, stand_in, experiment.values)) continue;
            is_put = true;
            const auto& label = choice_of(*stage, stand_in).label;
            const auto what = stage->label + ": " + label;
            auto alone = base;
            alone.values[stage->key] = stand_in;
            experiment.values[stage->key] = stand_in;
            const auto next = run.picture(experiment, what);
            const double now = run.rmse(next, truth);
            const bool is_first = experiment.values == alone.values;
            const double lone = is_first ? now : run.rmse(run.picture(alone, what + ", alone"), truth);
            const auto key = stage->key + "-" + stand_in;
            bars.begin_row(what);
            bars.add(key, before, now,
                     {{stage->label},
                      {label},
                      number_cell(now),
                      change_cell(now - before),
                      part(now - before),
                      change_cell(lone - first)});
            const auto was = run.distance(picture, truth);
            auto gained = run.distance(next, truth);
            for (std::size_t i = 0; i < gained.pixels.size(); ++i) gained.pixels[i] -= was.pixels[i];
            result.pictures.push_back({key,
                                       what,
                                       "Change of the distance from the reference: blue is nearer, red is "
                                       "farther.",
                                       true,
                                       {},
                                       std::move(gained)});
            picture = next;
            before = now;
        }
        if (!is_put) exact_already.push_back(stage->label);
    }
    if (!exact_already.empty())
        bars.add_problem("exact already, or without a meaning here: " + projects::listed(exact_already));
    bars.begin_row("What is left");
    bars.add("left", 0, before, {{"What is left"}, {""}, number_cell(before), {""}, part(before), {""}});
    result.pictures.push_back(
        {"left", "What is left", "Distance from the reference.", false, {}, run.distance(picture, truth)});
    run.note(
        "stand-ins are put in one after another, in the order of the parameters; 'alone' is the change "
        "that each makes by itself");
    result.data = std::move(bars).finish(run.notes());
    return result;
}

}  // namespace ir::engine
