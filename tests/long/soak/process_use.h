#pragma once

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/watched_gl.h"

namespace ir::test {

/// What the process holds. No member allocates: a reserved list of these adds nothing to the heap while it is
/// filled. Memory and heap are in MiB, the others are numbers. The heap is what was asked for and not given
/// back; memory is what the allocator and the system make of it. Programs of OpenGL are counted apart: a
/// library keeps some of them.
struct Use {
    double memory = 0, heap = 0, handles = 0, threads = 0, gl_objects = 0, gl_programs = 0;
};

inline double entries_in(const char* folder) {
    return double(std::distance(std::filesystem::directory_iterator(folder), {}));
}

inline Use use_now() {
    ::malloc_trim(0);  // what is free already is nobody's
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    const auto allocated = ::mallinfo2();  // of all arenas
    Use use{.memory = double(resident * ::sysconf(_SC_PAGESIZE)) / (1 << 20),
            .heap = double(allocated.uordblks + allocated.hblkhd) / (1 << 20),
            .handles = entries_in("/proc/self/fd"),
            .threads = entries_in("/proc/self/task")};
    for (const auto& [kind, count] : living_gl_objects())
        (kind == "Programs" ? use.gl_programs : use.gl_objects) += count;
    return use;
}

/// The least of what `kind` is in the last quarter, and in the one before. The first half is warm-up.
struct LeastUse {
    double before = 0, after = 0;

    LeastUse(const std::vector<Use>& uses, double Use::*kind) {
        const auto quarter = uses.size() / 4;
        const auto least = [&](std::size_t from) {
            double found = uses[from].*kind;
            for (auto i = from; i < from + quarter; ++i) found = std::min(found, uses[i].*kind);
            return found;
        };
        before = least(uses.size() - 2 * quarter);
        after = least(uses.size() - quarter);
    }
};

}  // namespace ir::test
