#pragma once

#include <string>
#include <vector>

#include "projects/edits.h"

/// Names that the program gives, and that follow what they are made of. They are told by their text alone, so
/// nothing of it is stored: who types the very name that the program would give lets it follow as well.
namespace ir::projects {

/// `wanted`, with a number behind it where an experiment other than `id` is called so: "Fog 2".
std::string free_name(const Project& project, const std::string& wanted, const std::string& id = {});
/// "Fog reference"
std::string reference_name(const std::string& experiment);
/// "Fog / Photograph"
std::string comparison_name(const std::string& a, const std::string& b);

/// Whether the experiment is called as the program called it: after its method, also as a copy or with a
/// number, or, where it is a ground truth, after an experiment that it judges or any method.
bool is_named_by_program(const Project& project, const Experiment& experiment, const Registry& registry);

/// The edits by which names that were made of this experiment's become those that `after`, which replaces it,
/// gives: of its reference where `reference_follows`, and of comparisons.
std::vector<EditPtr> following_names(const Project& project, const Experiment& after, bool reference_follows);

}  // namespace ir::projects
