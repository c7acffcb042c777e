#pragma once

#include <algorithm>
#include <cstdint>

#include "renderers/gl/program.h"

namespace ir::gl {

/// Which items a dispatch works on: uniforms `first_item` and `end_item`.
struct Items {
    unsigned first_item, end_item;
    IR_FIELDS(first_item, end_item)
};

/// Runs a compute program in use for the items [begin, end), an invocation each. In parts, as devices need
/// not take more than 65,535 groups at once.
inline void dispatch_items(const Program& program, std::int64_t begin, std::int64_t end) {
    constexpr std::int64_t max_at_once = std::int64_t{1} << 21;
    for (; begin < end; begin += max_at_once) {
        const auto part_end = std::min(end, begin + max_at_once);
        program.set(Items{static_cast<unsigned>(begin), static_cast<unsigned>(part_end)});
        program.dispatch(part_end - begin);
    }
}

}  // namespace ir::gl
