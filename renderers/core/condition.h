#pragma once

#include <string>
#include <vector>

#include "renderers/core/value.h"

namespace ir {

/// "active when parameter `key` has one of `values`"; an empty key means always active.
struct Condition {
    std::string key;
    std::vector<Value> values;
};

}  // namespace ir
