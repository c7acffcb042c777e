#include "projects/changes.h"

#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

constexpr std::size_t shortest_key = 6;

const KeptResult* find_by_prefix(const ResultIndex& index, const std::string& text) {
    if (const auto* exact = index.find(text)) return exact;
    const KeptResult* found = nullptr;
    if (text.size() < shortest_key) return nullptr;
    for (const auto& entry : index.entries()) {
        if (entry.key.compare(0, text.size(), text) != 0) continue;
        if (found)
            throw UsageError("several kept results begin with '" + printable(text, 60) +
                             "'; give more of the key");
        found = &entry;
    }
    return found;
}

/// The runs that a picture was resumed from: "build, device, samples" each.
std::string runs_of(const Provenance& provenance) {
    const auto runs = provenance.extra.find("resumed_from");
    if (runs == provenance.extra.end() || !runs->is_array()) return "none";
    std::vector<std::string> texts;
    for (const auto& run : *runs) {
        if (!run.is_object()) continue;
        const auto text = [&](const char* key) {
            return run.contains(key) && run[key].is_string() ? run[key].get<std::string>() : std::string("?");
        };
        const bool counted = run.contains("samples") && run["samples"].is_number();
        texts.push_back((counted ? run["samples"].dump() : "?") + " samples by " + text("build") + " on " +
                        text("driver") + " (" + text("backend") + ")");
    }
    return texts.empty() ? "none" : printable(listed(texts), 400);
}

}  // namespace

ResultVersion version_of(const KeptResult& kept) {
    return {printable(kept.experiment, 60) + ", kept " + printable(kept.provenance.date, 40), kept.key,
            kept.inputs, kept.provenance, kept.samples};
}

ResultVersion version_now(const Project& project, const Experiment& experiment, const Registry& registry) {
    return {experiment.id + " now",
            result_key(project, experiment, registry),
            picture_inputs(project, experiment, registry),
            {},
            0};
}

ResultVersion find_version(const std::string& text, const Project& project, const ResultIndex& index,
                           const Registry& registry) {
    constexpr std::string_view now = "now:";
    if (text.starts_with(now))
        return version_now(project, experiment_of(project, text.substr(now.size())), registry);
    if (const auto* experiment = find_item(project.experiments, text)) {
        if (experiment->last_kept_key.empty())
            throw UsageError("experiment '" + text + "' has no kept result; render it with --keep");
        if (const auto* kept = index.find(experiment->last_kept_key)) return version_of(*kept);
        throw UsageError("the kept result of '" + text + "' is not listed any more; render it with --keep");
    }
    if (const auto* kept = find_by_prefix(index, text)) return version_of(*kept);
    throw UsageError("'" + printable(text, 60) +
                     "' is neither an experiment nor the beginning (6 characters or more) of a kept result's "
                     "key, nor now:EXPERIMENT");
}

Changes changes(const ResultVersion& before, const ResultVersion& now) {
    Changes result;
    result.inputs = differences(before.inputs, now.inputs);
    if (!before.provenance || !now.provenance) return result;
    const auto add = [&](const char* what, const std::string& a, const std::string& b) {
        if (a != b)
            result.provenance.push_back(std::string(what) + ": " + printable(a, 400) + " → " +
                                        printable(b, 400));
    };
    add("build", before.provenance->build, now.provenance->build);
    add("device", before.provenance->driver, now.provenance->driver);
    add("backend", before.provenance->backend, now.provenance->backend);
    if (!before.provenance->processor.empty() && !now.provenance->processor.empty())
        add("processor", before.provenance->processor, now.provenance->processor);
    add("date", before.provenance->date, now.provenance->date);
    if (before.samples > 0 && now.samples > 0)
        add("samples", std::to_string(before.samples), std::to_string(now.samples));
    add("resumed from", runs_of(*before.provenance), runs_of(*now.provenance));
    return result;
}

}  // namespace ir::projects
