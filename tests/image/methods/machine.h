#pragma once

#include "app/engine/execution.h"

namespace ir::engine {

/// The one that all tests of a process draw with.
inline Machine& machine() {
    static Machine instance;
    return instance;
}

}  // namespace ir::engine
