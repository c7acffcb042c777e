#include "renderers/methods/deep-screen-space/surfels/packing.h"

#include <algorithm>

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of parts.glsl.
struct FirstPart {
    unsigned first_part;
    IR_FIELDS(first_part)
};

}  // namespace

void dispatch_parts(const gl::Program& program, std::uint64_t capacity, graph::Slice slice) {
    constexpr std::int64_t block = 64;
    const auto blocks = (static_cast<std::int64_t>(capacity) + block - 1) / block;
    program.set(FirstPart{static_cast<unsigned>(slice.begin)});
    program.dispatch(block * (slice.end - slice.begin), (blocks + packing_parts - 1) / packing_parts);
}

Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve) {
    desc.elements = std::max<std::uint64_t>(1, reserve);
    desc.growable = true;
    desc.lower = "the number of surfels (raise 'surfel_radius')";
    Growing result;
    result.buffer = builder.buffer(std::move(desc));
    counter.growth_of = result.buffer;
    result.count = builder.counter(std::move(counter));
    return result;
}

}  // namespace ir::methods::deep_screen_space
