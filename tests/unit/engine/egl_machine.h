#pragma once

#include "app/engine/execution.h"

namespace ir::engine {

/// On EGL, one for all tests of a process.
inline Machine& egl_machine() {
    static Machine instance{{"egl", {}, false, 0}};
    return instance;
}

}  // namespace ir::engine
