#pragma once

#include <ctime>

namespace ir {

/// Seconds that processors worked for this process: what else the machine does is not in it.
inline double processor_seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// The same for this thread alone.
inline double thread_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

}  // namespace ir
