#pragma once

#include <string>
#include <vector>

#include "projects/match.h"

namespace ir::projects {

/// Experiments that answer a question together.
struct SetUp {
    EditPtr edit;                          ///< one step of undo; null: all are there already
    std::vector<std::string> experiments;  ///< ids, in the order of their pictures
};

/// Every method that computes such paths ("ao", "full", …), at its defaults, and their ground truth behind
/// them, with scene, camera, lights, size, frames and time of an experiment. What the project has already is
/// taken. Without any such method there are no experiments. Throws UsageError as match().
SetUp methods_beside_truth(const Project& project, const std::string& experiment, const std::string& paths,
                           const Registry& registry, const AnimatedScene& is_animated);

}  // namespace ir::projects
