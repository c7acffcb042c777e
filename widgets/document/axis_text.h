#pragma once

#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/method.h"

namespace ir::widgets {

/// The values of a sweep's axis as people type them: "1, 2, 4", "plain, fancy", "512x512, 1024x1024".
std::string axis_text(const projects::Sweep::Axis& axis);
/// Values of such a text for the key; numbers, true and false as such, sizes as WIDTHxHEIGHT, all else as
/// text. Throws UsageError for an empty value or a size that is none.
std::vector<projects::Json> parse_axis(const std::string& key, const std::string& text);

/// Keys that every experiment has besides its method's parameters.
const std::vector<std::string>& general_axis_keys();
/// What people call a key: the label of the parameter of the first experiment whose method has it, or itself.
std::string axis_label(const projects::Project& project, const Registry& registry,
                       const std::vector<std::string>& experiments, const std::string& key);
/// What the experiment has now for a key; null where it has nothing such.
projects::Json present_value(const projects::Experiment& experiment, const std::string& key);

}  // namespace ir::widgets
