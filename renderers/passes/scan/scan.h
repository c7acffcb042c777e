#pragma once

#include <string>

#include "renderers/graph/builder.h"

namespace ir::passes {

/// Declares "KEY.places" and the passes that fill it: for each of the first `items` words of `counts` the sum
/// of the words before it. Their total is added to the counter `total`. The order of what is packed by these
/// places is that of the items, on every device and in every run.
graph::BufferRef exclusive_scan(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef counts,
                                std::uint64_t items, graph::CounterRef total);

}  // namespace ir::passes
