#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "renderers/core/value.h"

namespace ir {

/// "active when parameter `key` has one of `values`"; an empty key means always active.
struct Condition {
    std::string key;
    std::vector<Value> values;
};

/// Whether it is met; where the settings lack the key, nothing speaks against it.
inline bool holds(const Condition& condition, const Settings& settings) {
    const auto found = settings.find(condition.key);
    return found == settings.end() || std::find(condition.values.begin(), condition.values.end(),
                                                found->second) != condition.values.end();
}

}  // namespace ir
