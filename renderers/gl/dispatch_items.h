#pragma once

#include <algorithm>
#include <cstdint>

#include "renderers/gl/program.h"

namespace ir::gl {

/// Runs a compute program in use for the items [begin, end), an invocation each, which it is told by the
/// uniforms `first` and `end_name`. In parts, as devices need not take more than 65,535 groups at once.
inline void dispatch_items(const Program& program, std::int64_t begin, std::int64_t end,
                           const char* first = "first_item", const char* end_name = "end_item") {
    constexpr std::int64_t max_at_once = std::int64_t{1} << 21;
    for (; begin < end; begin += max_at_once) {
        const auto part_end = std::min(end, begin + max_at_once);
        program.set(first, static_cast<unsigned>(begin));
        program.set(end_name, static_cast<unsigned>(part_end));
        program.dispatch(part_end - begin);
    }
}

}  // namespace ir::gl
