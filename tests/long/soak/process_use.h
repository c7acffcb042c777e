#pragma once

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/watched_gl.h"

namespace ir::test {

/// What the process holds, by name: memory in MiB, the others as numbers. The heap is what was asked for and
/// not given back; memory is what the allocator and the system make of it. Programs of OpenGL are counted
/// apart: a library keeps some of them.
using Use = std::map<std::string, double>;

inline double entries_in(const char* folder) {
    return double(std::distance(std::filesystem::directory_iterator(folder), {}));
}

inline Use use_now() {
    ::malloc_trim(0);  // what is free already is nobody's
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    const auto allocated = ::mallinfo2();  // of all arenas
    Use use{{"memory", double(resident * ::sysconf(_SC_PAGESIZE)) / (1 << 20)},
            {"heap", double(allocated.uordblks + allocated.hblkhd) / (1 << 20)},
            {"handles", entries_in("/proc/self/fd")},
            {"threads", entries_in("/proc/self/task")},
            {"OpenGL objects", 0},
            {"programs", 0}};
    for (const auto& [kind, count] : living_gl_objects())
        use[kind == "Programs" ? "programs" : "OpenGL objects"] += count;
    return use;
}

/// How much more of a kind is used at least in the last quarter than in the one before: 1.02 is 2 % more. The
/// first half is warm-up.
inline double growth(const std::vector<Use>& uses, const std::string& kind) {
    const auto quarter = uses.size() / 4;
    const auto least = [&](std::size_t from) {
        double found = uses[from].at(kind);
        for (auto i = from; i < from + quarter; ++i) found = std::min(found, uses[i].at(kind));
        return found;
    };
    const double before = least(uses.size() - 2 * quarter);
    return before > 0 ? least(uses.size() - quarter) / before : 1;
}

}  // namespace ir::test
