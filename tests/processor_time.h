#pragma once

#include <ctime>

namespace ir {

/// Seconds that processors worked for this process: what else the machine does is not in it.
inline double processor_seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace ir
