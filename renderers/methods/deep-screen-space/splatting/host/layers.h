#pragma once

#include <span>
#include <vector>

#include "renderers/graph/pass_context.h"

namespace ir::methods::deep_screen_space {

/// All layers of a stack on the host.
template <class T>
std::vector<std::span<T>> layers(const graph::PassContext& p, graph::ImageRef stack) {
    std::vector<std::span<T>> result;
    for (int layer = 0; layer < p.shape(stack).layers; ++layer) result.push_back(p.pixels<T>(stack, layer));
    return result;
}

}  // namespace ir::methods::deep_screen_space
