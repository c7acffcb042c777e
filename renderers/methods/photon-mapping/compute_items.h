#pragma once

#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"

namespace ir::methods::photon_mapping {

/// An invocation for each of so many items, in slices; `first_slice` is the size of the first one.
inline void compute_items(graph::PassBuilder& pass, const gl::ProgramSource& source, std::int64_t items,
                          std::int64_t first_slice, graph::Constants constants) {
    pass.execute_sliced(
        items,
        [=](graph::PassContext& context, graph::Slice slice) {
            const auto& program = context.use(source);
            constants.give(context, program);
            gl::dispatch_items(program, slice.begin, slice.end);
        },
        first_slice);
}

}  // namespace ir::methods::photon_mapping
