#pragma once

#include <cstdint>
#include <string>

#include "renderers/gl/program.h"
#include "renderers/graph/pass_context.h"

namespace ir::methods::deep_screen_space {

/// Passes over items whose number only the device knows are divided into so many parts of the capacity.
constexpr std::int64_t packing_parts = 256;

struct ItemRange {
    std::int64_t first, end;
};
/// The items of a slice of `packing_parts`.
ItemRange items_of(std::uint64_t capacity, graph::Slice slice);

/// Declares a growable buffer with the counter that makes it grow, of `reserve` elements at first.
struct Growing {
    graph::BufferRef buffer;
    graph::CounterRef count;
};
Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve);

/// Declares passes that replace the words of a growable buffer, as many as it has room for, by the sum of the
/// words before each, and add the total to the counter. What is packed by these places has the order of the
/// items, in every run. Throws Error while a frame runs with more than 2^26 words.
void scan_in_place(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef words,
                   graph::CounterRef total);

}  // namespace ir::methods::deep_screen_space
