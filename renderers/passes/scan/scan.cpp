#include "renderers/passes/scan/scan.h"

#include <algorithm>
#include <stdexcept>

#include "renderers/graph/pass_context.h"

namespace ir::passes {
namespace {

constexpr std::int64_t tile_items = 2048, group_size = 256;  ///< shaders/passes/scan/tile.glsl
/// So that every device takes the tiles in one dispatch.
constexpr std::uint64_t most_items = 1 << 26;
/// Tiles of the first slice of a pass, about 1 ms on two cores.
constexpr std::int64_t first_slice = 512;

graph::BufferRef declare(graph::GraphBuilder& builder, graph::ResourceText text, const std::string& field,
                         std::uint64_t elements) {
    return builder.buffer(
        {.text = std::move(text), .fields = {{field, graph::FieldType::u32}}, .elements = elements});
}

/// What the passes over tiles share.
struct Scan {
    graph::BufferRef counts, bases, places;
    std::uint64_t items;

    const gl::Program& use(const graph::PassContext& context, const char* file) const {
        context.bind_buffer(0, counts);
        context.bind_buffer(1, bases);
        const auto& program = context.program({{file}});
        program.use();
        // a growable buffer may still be too small for all items
        program.set("counted", static_cast<unsigned>(std::min(items, context.capacity(counts))));
        return program;
    }

    void sum(const graph::PassContext& context, graph::Slice slice) const {
        dispatch(use(context, "passes/scan/sums.comp"), slice);
    }

    void place(const graph::PassContext& context, graph::Slice slice) const {
        const auto& program = use(context, "passes/scan/places.comp");
        context.bind_buffer(2, places);
        program.set("item_count", static_cast<unsigned>(items));
        dispatch(program, slice);
    }

    /// A work group for each tile of the slice.
    static void dispatch(const gl::Program& program, graph::Slice slice) {
        program.set("first_tile", static_cast<unsigned>(slice.begin));
        program.dispatch((slice.end - slice.begin) * group_size);
    }
};

}  // namespace

graph::BufferRef exclusive_scan(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef counts,
                                std::uint64_t items, graph::CounterRef total) {
    if (items > most_items) throw std::logic_error("scan '" + key + "': more than 2^26 items");
    const auto tiles = (static_cast<std::int64_t>(items) + tile_items - 1) / tile_items;
    const auto bases =
        declare(builder,
                {.key = key + ".bases",
                 .label = "Sums before tiles",
                 .doc = "For each tile of 2048 counts the sum of all counts before it, for " + key + "."},
                "sum", static_cast<std::uint64_t>(tiles));
    const auto places = declare(builder,
                                {.key = key + ".places",
                                 .label = "Places",
                                 .doc = "For each item the sum of the counts before it, for " + key + "."},
                                "place", items);
    const Scan scan{counts, bases, places, items};
    builder.pass(key + " sums")
        .reads(counts)
        .writes(bases)
        .execute_sliced(
            tiles, [=](graph::PassContext& context, graph::Slice slice) { scan.sum(context, slice); },
            first_slice);
    builder.pass(key + " bases").writes(bases).counts(total).execute([=](graph::PassContext& context) {
        context.bind_buffer(1, bases);
        context.bind_counter(2, total);
        const auto& program = context.program({{"passes/scan/bases.comp"}});
        program.use();
        program.set("tile_count", static_cast<unsigned>(tiles));
        program.dispatch(1);
    });
    builder.pass(key + " places")
        .reads(counts, bases)
        .writes(places)
        .execute_sliced(
            tiles, [=](graph::PassContext& context, graph::Slice slice) { scan.place(context, slice); },
            first_slice);
    return places;
}

}  // namespace ir::passes
