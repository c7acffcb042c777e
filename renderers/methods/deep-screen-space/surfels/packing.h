#pragma once

#include <cstdint>
#include <string>

#include "renderers/gl/program.h"
#include "renderers/graph/pass_context.h"
#include "shaders/methods/deep-screen-space/surfels/parts.glsl.h"

namespace ir::methods::deep_screen_space {

/// Passes over items whose number only the device knows are divided into so many parts (parts.glsl).
inline constexpr std::int64_t packing_parts = parts;

/// Runs a compute program in use, with groups of 64 that include parts.glsl, for a slice of the parts of a
/// list with this capacity. Gives the constants of parts.glsl.
void dispatch_parts(const gl::Program& program, std::uint64_t capacity, graph::Slice slice);

/// Declares a growable buffer with the counter that makes it grow, of `reserve` elements at first.
struct Growing {
    graph::BufferRef buffer;
    graph::CounterRef count;
};
Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve);

}  // namespace ir::methods::deep_screen_space
