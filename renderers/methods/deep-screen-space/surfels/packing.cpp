#include "renderers/methods/deep-screen-space/surfels/packing.h"

#include <algorithm>

#include "renderers/core/error.h"

namespace ir::methods::deep_screen_space {
namespace {

constexpr std::int64_t tile_items = 2048, group_size = 256;  ///< shaders/passes/scan/tile.glsl
constexpr std::int64_t most_tiles = std::int64_t{1} << 15;
constexpr std::int64_t first_slice = 512;

std::int64_t tiles_of(const graph::PassContext& context, graph::BufferRef words) {
    const auto tiles = (static_cast<std::int64_t>(context.capacity(words)) + tile_items - 1) / tile_items;
    if (tiles > most_tiles)
        throw Error("deep screen space: more than 2^26 surfels; raise surfel_radius or fine_area");
    return tiles;
}

/// A work group for each tile of the slice that is there.
void dispatch(const graph::PassContext& context, const gl::Program& program, graph::BufferRef words,
              graph::Slice slice) {
    const auto end = std::min(slice.end, tiles_of(context, words));
    program.set("first_tile", static_cast<unsigned>(slice.begin));
    program.set("counted", static_cast<unsigned>(context.capacity(words)));
    if (slice.begin < end) program.dispatch((end - slice.begin) * group_size);
}

}  // namespace

void dispatch_parts(const gl::Program& program, std::uint64_t capacity, graph::Slice slice) {
    constexpr std::int64_t block = 64;
    const auto blocks = (static_cast<std::int64_t>(capacity) + block - 1) / block;
    program.set("first_part", static_cast<unsigned>(slice.begin));
    program.dispatch(block * (slice.end - slice.begin), (blocks + packing_parts - 1) / packing_parts);
}

Growing growing(graph::GraphBuilder& builder, graph::BufferDesc desc, graph::CounterDesc counter,
                std::uint64_t reserve) {
    desc.elements = std::max<std::uint64_t>(1, reserve);
    desc.growable = true;
    desc.lower = "reserve, or raise surfel_radius";
    Growing result;
    result.buffer = builder.buffer(std::move(desc));
    counter.growth_of = result.buffer;
    result.count = builder.counter(std::move(counter));
    return result;
}

void scan_in_place(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef words,
                   graph::CounterRef total) {
    const auto bases =
        builder.buffer({.text = {.key = key + ".bases",
                                 .label = "Sums before tiles",
                                 .doc = "For each tile of 2048 words the sum of all before it."},
                        .fields = {{"sum", graph::FieldType::u32}},
                        .elements = most_tiles});
    builder.pass(key + " sums")
        .reads(words)
        .writes(bases)
        .execute_sliced(
            most_tiles,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.program({{"passes/scan/sums.comp"}});
                program.use();
                context.bind_buffer(0, words);
                context.bind_buffer(1, bases);
                dispatch(context, program, words, slice);
            },
            first_slice);
    builder.pass(key + " bases")
        .reads(words)
        .writes(bases)
        .counts(total)
        .execute([=](graph::PassContext& context) {
            const auto& program = context.program({{"passes/scan/bases.comp"}});
            program.use();
            context.bind_buffer(1, bases);
            context.bind_counter(2, total);
            program.set("tile_count", static_cast<unsigned>(tiles_of(context, words)));
            program.dispatch(1);
        });
    // Each work group has read its tile before it writes it.
    builder.pass(key + " places")
        .reads(bases)
        .writes(words)
        .execute_sliced(
            most_tiles,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.program({{"passes/scan/places.comp"}});
                program.use();
                context.bind_buffer(0, words);
                context.bind_buffer(1, bases);
                context.bind_buffer(2, words);
                program.set("item_count", static_cast<unsigned>(context.capacity(words)));
                dispatch(context, program, words, slice);
            },
            first_slice);
}

}  // namespace ir::methods::deep_screen_space
