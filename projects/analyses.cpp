#include "projects/analyses.h"

#include <algorithm>
#include <sstream>

#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

/// Colours that are told apart in a picture of names.
constexpr std::size_t max_disagreeing = 7;

bool is_picture(const Project& project, const std::string& id) {
    return find_item(project.experiments, id) || find_item(project.images, id);
}

/// Whether both see the same through the same pixels, as far as ids tell.
bool is_seen_alike(const Experiment& a, const Experiment& b) {
    const auto one = effective(a), other = effective(b);
    return one.scene == other.scene && one.camera == other.camera && one.size == other.size;
}

std::string count_word(std::size_t count) {
    static const std::array<const char*, 3> words{"no", "one", "two"};
    return count < words.size() ? words[count] : std::to_string(count);
}

std::string why_not_counted(const AnalysisKind& kind, std::size_t count) {
    if (count >= kind.min_experiments && count <= kind.max_experiments) return {};
    const auto wanted =
        kind.min_experiments == kind.max_experiments
            ? count_word(kind.min_experiments)
            : std::to_string(kind.min_experiments) + " to " + std::to_string(kind.max_experiments);
    return "it is about " + count_word(count) + (count > 1 ? " experiments" : " experiment") + "; choose " +
           wanted + (kind.needs_one_method ? " of one method" : "");
}

std::string why_not_machines(const std::vector<std::string>& names) {
    if (names.size() != 2)
        return "it compares two machines, and names " + std::to_string(names.size()) + "; give two such as " +
               default_machines[0] + " and " + default_machines[1] + ", or none";
    for (const auto& name : names)
        if (!read_machine_name(name))
            return "'" + printable(name, 60) + "' is no machine; give " + machine_words;
    if (read_machine_name(names[0]) == read_machine_name(names[1]))
        return "it compares '" + names[0] + "' with itself; name another machine";
    return {};
}

std::string why_not_parameters(const AnalysisKind& kind, const Analysis& analysis,
                               const MethodDescription& method) {
    if (analysis.parameters.empty()) return {};
    if (kind.compares_machines) return why_not_machines(analysis.parameters);
    if (!kind.takes_parameters) return "it takes no parameters; leave them out";
    for (const auto& key : analysis.parameters)
        if (!find(method.parameters, key))
            return "'" + printable(key, 60) + "' is no parameter of " + method.id +
                   known_are(key, words_of(method.parameters, &ParameterDescription::key));
    return {};
}

/// Whether one of these parameters names an exact stand-in; without keys: any.
bool has_stand_in(const MethodDescription& method, const std::vector<std::string>& keys) {
    return std::ranges::any_of(method.parameters, [&](const ParameterDescription& parameter) {
        return !parameter.exact.empty() && (keys.empty() || std::ranges::count(keys, parameter.key) > 0);
    });
}

std::string why_not_stand_ins(const Analysis& analysis, const MethodDescription& method,
                              const Registry& registry) {
    if (has_stand_in(method, analysis.parameters)) return {};
    if (has_stand_in(method, {})) return "it names parameters without exact stand-ins; leave them out";
    std::vector<std::string> others;
    for (const auto* other : registry.methods())
        if (has_stand_in(*other, {})) others.push_back(other->id);
    return "it is about " + method.id + ", which names no exact stand-ins" +
           (others.empty() ? "" : "; choose an experiment by one of " + listed(others));
}

}  // namespace

const std::vector<AnalysisKind>& analysis_kinds() {
    static const std::vector<AnalysisKind> kinds{
        {.key = "disagreement",
         .label = "Disagreement",
         .doc = "Where experiments differ from each other, and which of them is nearest to the reference. "
                "Without a reference: which is farthest from the others.",
         .min_experiments = 2,
         .max_experiments = max_disagreeing},
        {.key = "sensitivity",
         .label = "Sensitivity",
         .doc =
             "How much the error changes with each number of an experiment, a step down and a step up, and "
             "where in the picture. Without a reference: how much the picture changes.",
         .takes_parameters = true},
        {.key = "attribution",
         .label = "Attribution",
         .doc = "Which of the settings in which two experiments of one method differ makes how much of the "
                "difference between their pictures or, with a reference, between their errors.",
         .min_experiments = 2,
         .max_experiments = 2,
         .needs_one_method = true},
        {.key = "waterfall",
         .label = "Error waterfall",
         .doc = "Which stage of a method owns the error: what is left of it when exact stand-ins take the "
                "place of one stage after another.",
         .needs_reference = true,
         .takes_parameters = true,
         .needs_stand_ins = true},
        {.key = "divergence",
         .label = "Divergence",
         .doc = "The first buffer that two processors or drivers make differently, and by how much each of "
                "those behind it differs.",
         .compares_machines = true},
        {.key = "frames",
         .label = "Time machine",
         .doc = "The last frames of an experiment, of any of its images: as its samples add up, or as time "
                "passes. How much each changes and, with a reference, how far it is from it.",
         .takes_frames = true}};
    return kinds;
}

const AnalysisKind* find_analysis_kind(const std::string& key) {
    const auto& kinds = analysis_kinds();
    const auto found = std::ranges::find(kinds, key, &AnalysisKind::key);
    return found == kinds.end() ? nullptr : &*found;
}

std::optional<MachineName> read_machine_name(const std::string& text) {
    MachineName name;
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, '+');) {
        auto& part = word == "gl" || word == "host" ? name.processor : name.backend;
        if (!part.empty() || (&part == &name.backend && word != "egl" && word != "osmesa")) return {};
        part = word;
    }
    if (name == MachineName()) return {};
    return name;
}

std::array<std::string, 2> machines_of(const Analysis& analysis) {
    if (analysis.parameters.size() != 2) return {default_machines[0], default_machines[1]};
    return {analysis.parameters[0], analysis.parameters[1]};
}

bool is_main_output(const Project& project, const std::string& experiment, const std::string& output,
                    const Registry& registry) {
    const auto* found = find_item(project.experiments, experiment);
    const auto* method = found ? registry.find(found->method) : nullptr;
    const auto* main = method ? main_output(*method, effective(*found).values) : nullptr;
    return output.empty() || !main || output == main->key;
}

std::string why_not_analysed(const Project& project, const Analysis& analysis, const Registry& registry) {
    const auto* kind = find_analysis_kind(analysis.kind);
    if (!kind)
        return "question '" + printable(analysis.kind, 60) + "' is unknown" +
               known_are(analysis.kind, words_of(analysis_kinds(), &AnalysisKind::key));
    if (const auto why = why_not_counted(*kind, analysis.experiments.size()); !why.empty()) return why;
    std::vector<const Experiment*> experiments;
    for (const auto& id : analysis.experiments) {
        const auto* experiment = find_item(project.experiments, id);
        if (!experiment) return "there is no experiment '" + printable(id, 60) + "'; choose another";
        if (!registry.find(experiment->method))
            return "experiment '" + id + "' has the method '" + printable(experiment->method, 60) +
                   "', which is unknown to this build";
        if (std::ranges::find(experiments, experiment) != experiments.end())
            return "experiment '" + id + "' is named twice; take one out";
        experiments.push_back(experiment);
    }
    if (kind->compares_machines && !analysis.reference.empty())
        return "it compares two machines with each other; take the reference out";
    if (kind->needs_reference && analysis.reference.empty()) return "it has no reference; choose one";
    if (!analysis.reference.empty() && !is_picture(project, analysis.reference))
        return "there is no experiment or image '" + printable(analysis.reference, 60) +
               "' to be its reference; choose another";
    if (std::ranges::find(analysis.experiments, analysis.reference) != analysis.experiments.end())
        return "the reference is one of the experiments; take it out";
    if (kind->takes_frames && !analysis.reference.empty() &&
        !is_main_output(project, analysis.experiments[0], analysis.output, registry))
        return "it is about '" + printable(analysis.output, 60) +
               "', and a reference shows the main result; take one of the two out";
    if (kind->needs_one_method && experiments[0]->method != experiments[1]->method)
        return "it asks about two experiments of one method, and '" + experiments[0]->id + "' is by " +
               experiments[0]->method + ", '" + experiments[1]->id + "' by " + experiments[1]->method;
    const auto& method = registry.at(experiments[0]->method);
    if (const auto why = why_not_parameters(*kind, analysis, method); !why.empty()) return why;
    return kind->needs_stand_ins ? why_not_stand_ins(analysis, method, registry) : std::string();
}

Analysis analysis_of(const Project& project, const std::string& kind_key, const std::string& id,
                     const Registry& registry, const std::string& output) {
    const auto* kind = find_analysis_kind(kind_key);
    if (!kind)
        throw UsageError("question '" + printable(kind_key, 60) + "' is unknown" +
                         known_are(kind_key, words_of(analysis_kinds(), &AnalysisKind::key)));
    const auto& first = experiment_of(project, id);
    Analysis analysis;
    analysis.name = kind->label;
    analysis.id = free_id_in(project.analyses, kind->label);
    analysis.kind = kind->key;
    analysis.experiments = {first.id};
    analysis.output = output;
    if (!kind->compares_machines && is_main_output(project, id, output, registry))
        analysis.reference = first.reference;
    const auto add = [&](bool is_same_method) {
        for (const auto& other : project.experiments) {
            const auto* method = registry.find(other.method);
            const bool fits = other.id != first.id && other.id != analysis.reference && method &&
                              !method->is_reference && (other.method == first.method) == is_same_method &&
                              is_seen_alike(first, other);
            if (fits && analysis.experiments.size() < kind->max_experiments)
                analysis.experiments.push_back(other.id);
        }
    };
    add(true);
    if (!kind->needs_one_method) add(false);
    return analysis;
}

Analysis proposed_analysis(const Project& project, const std::string& kind, const std::string& experiment,
                           const Registry& registry) {
    const auto asked = analysis_of(project, kind, experiment, registry);
    if (why_not_analysed(project, asked, registry).empty()) return asked;
    for (const auto& other : project.experiments) {
        const auto* method = registry.find(other.method);
        if (!method || method->is_reference) continue;
        const auto proposed = analysis_of(project, kind, other.id, registry);
        if (why_not_analysed(project, proposed, registry).empty()) return proposed;
    }
    return asked;
}

std::string analysis_path(const std::string& analysis) {
    return "analyses/" + analysis;
}

}  // namespace ir::projects
