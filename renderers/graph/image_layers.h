#pragma once

#include <span>
#include <vector>

#include "renderers/graph/pass_context.h"

namespace ir::graph {

/// The texels of all layers of a stack on the host, as PassContext::pixels has those of one.
template <class T>
std::vector<std::span<T>> layers(const PassContext& context, ImageRef stack) {
    std::vector<std::span<T>> result;
    for (int layer = 0; layer < context.shape(stack).layers; ++layer)
        result.push_back(context.pixels<T>(stack, layer));
    return result;
}

}  // namespace ir::graph
