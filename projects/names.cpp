#include "projects/names.h"

#include <algorithm>
#include <cctype>

#include "projects/edit_kinds.h"

namespace ir::projects {
namespace {

constexpr std::string_view copy_word = " copy", reference_word = " reference";

/// Whether `text` is what tells equal names apart: "", " 2", " copy", " copy 3".
bool is_ending(std::string_view text) {
    while (!text.empty()) {
        if (text.starts_with(copy_word)) {
            text.remove_prefix(copy_word.size());
            continue;
        }
        const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
        const auto end = std::find_if_not(text.begin() + 1, text.end(), is_digit);
        if (text.front() != ' ' || end == text.begin() + 1) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    }
    return true;
}

bool is_called(std::string_view name, std::string_view base) {
    return name.starts_with(base) && is_ending(name.substr(base.size()));
}

bool is_called_as_reference(const Project& project, const Experiment& experiment, const Registry& registry) {
    const std::string_view name = experiment.name;
    const auto at = name.rfind(reference_word);
    if (at == name.npos || !is_ending(name.substr(at + reference_word.size()))) return false;
    const auto judged = name.substr(0, at);
    return std::any_of(registry.methods().begin(), registry.methods().end(),
                       [&](const auto* method) { return is_called(judged, method->title); }) ||
           std::any_of(project.experiments.begin(), project.experiments.end(), [&](const auto& other) {
               return other.reference == experiment.id && other.name == judged;
           });
}

/// As people see an experiment or an image.
std::string name_of(const Project& project, const std::string& id) {
    const auto shown = [](const auto& item) { return item.name.empty() ? item.id : item.name; };
    if (const auto* experiment = find_item(project.experiments, id)) return shown(*experiment);
    if (const auto* image = find_item(project.images, id)) return shown(*image);
    return id;
}

}  // namespace

std::string free_name(const Project& project, const std::string& wanted, const std::string& id) {
    const auto is_taken = [&](const std::string& name) {
        return std::any_of(project.experiments.begin(), project.experiments.end(),
                           [&](const auto& each) { return each.id != id && each.name == name; });
    };
    std::string name = wanted;
    for (int i = 2; is_taken(name); ++i) name = wanted + " " + std::to_string(i);
    return name;
}

std::string reference_name(const std::string& experiment) {
    return experiment + std::string(reference_word);
}

std::string comparison_name(const std::string& a, const std::string& b) {
    return a + " / " + b;
}

bool is_named_by_program(const Project& project, const Experiment& experiment, const Registry& registry) {
    const auto* method = registry.find(experiment.method);
    if (!method) return false;
    return is_called(experiment.name, method->title) ||
           (method->is_reference && is_called_as_reference(project, experiment, registry));
}

std::vector<EditPtr> following_names(const Project& project, const Experiment& after,
                                     bool reference_follows) {
    std::vector<EditPtr> steps;
    auto ahead = project;
    auto& renamed = *find_item(ahead.experiments, after.id);
    const auto before = renamed.name;
    renamed = after;
    auto* truth = find_item(ahead.experiments, after.reference);
    if (reference_follows && truth && is_called(truth->name, reference_name(before))) {
        truth->name = free_name(ahead, reference_name(after.name), truth->id);
        steps.push_back(edits::replace(project, *truth, "Rename experiment", ""));
    }
    for (auto comparison : project.comparisons) {
        if (comparison.name !=
            comparison_name(name_of(project, comparison.a), name_of(project, comparison.b)))
            continue;
        comparison.name = comparison_name(name_of(ahead, comparison.a), name_of(ahead, comparison.b));
        steps.push_back(edits::replace(project, comparison, "Rename comparison", ""));
    }
    return steps;
}

}  // namespace ir::projects
