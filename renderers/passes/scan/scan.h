#pragma once

#include <string>

#include "renderers/graph/builder.h"

namespace ir::passes {

/// Declares "KEY.places" and the passes that fill it: for each of the first `items` words of `counts` the sum
/// of the words before it. Their total is added to the counter `total`. The order of what is packed by these
/// places is that of the items, on every device and in every run. What scans make has the fingerprint of what
/// they scan.
graph::BufferRef exclusive_scan(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef counts,
                                std::uint64_t items, graph::CounterRef total);

/// Declares passes that replace the words of a growable buffer, as many as it has room for, by the sum of the
/// words before each, and add the total to the counter. Throws Error, which names what the buffer's
/// description says to lower, while a frame runs with more than 2^26 words.
void scan_in_place(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef words,
                   graph::CounterRef total);

}  // namespace ir::passes
