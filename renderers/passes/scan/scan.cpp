#include "renderers/passes/scan/scan.h"

#include <algorithm>
#include <stdexcept>

#include "renderers/core/error.h"
#include "renderers/graph/pass_context.h"
#include "shaders/passes/scan/tile.glsl.h"

namespace ir::passes {
namespace {

constexpr std::int64_t tile_items = scan_tile, group_size = scan_group;
/// So that every device takes the tiles in one dispatch.
constexpr std::uint64_t max_items = 1 << 26;
/// Tiles of the first slice of a pass, about 1 ms on two cores.
constexpr std::int64_t first_slice = 512;

const graph::BufferDesc& desc_of(const graph::GraphBuilder& builder, graph::BufferRef buffer) {
    return builder.buffers().at(static_cast<std::size_t>(buffer.index));
}

graph::BufferRef declare(graph::GraphBuilder& builder, graph::ResourceText text, const std::string& field,
                         std::uint64_t elements, graph::BufferRef counts) {
    return builder.buffer({.text = std::move(text),
                           .fields = {{field, graph::FieldType::u32}},
                           .elements = elements,
                           .fingerprint = desc_of(builder, counts).fingerprint});
}

std::int64_t tiles_of(std::uint64_t items) {
    return (static_cast<std::int64_t>(items) + tile_items - 1) / tile_items;
}

/// Constants of sums.comp.
struct Sums {
    unsigned first_tile, counted;
    IR_FIELDS(first_tile, counted)
};

/// Constants of places.comp.
struct Places {
    Sums sums;
    unsigned item_count;
    IR_FIELDS(sums, item_count)
};

/// Constants of bases.comp.
struct Bases {
    unsigned tile_count;
    IR_FIELDS(tile_count)
};

/// What the passes over tiles share. In place `places` are `counts`, of as many items as there is room for.
struct Scan {
    std::string key;
    graph::BufferRef counts, bases, places;
    std::uint64_t items;
    std::string lower = {};  ///< in place: what makes fewer items

    bool in_place() const { return places.index == counts.index; }

    std::uint64_t items_of(const graph::PassContext& context) const {
        if (!in_place()) return items;
        const auto room = context.capacity(counts);
        if (room > max_items) throw Error("'" + key + "': more than 2^26 items; lower " + lower);
        return room;
    }

    /// A growable buffer may still be too small for all items.
    Sums constants(const graph::PassContext& context, graph::Slice slice) const {
        return {static_cast<unsigned>(slice.begin),
                static_cast<unsigned>(std::min(items_of(context), context.capacity(counts)))};
    }

    void sum(const graph::PassContext& context, graph::Slice slice) const {
        const auto& program = context.use({{"passes/scan/sums.comp"}});
        program.set(constants(context, slice));
        dispatch(context, program, slice);
    }

    void place(const graph::PassContext& context, graph::Slice slice) const {
        const auto& program = context.use({{"passes/scan/places.comp"}});
        program.set(Places{constants(context, slice), static_cast<unsigned>(items_of(context))});
        dispatch(context, program, slice);
    }

    void add_up(const graph::PassContext& context) const {
        const auto& program = context.use({{"passes/scan/bases.comp"}});
        program.set(Bases{static_cast<unsigned>(tiles_of(items_of(context)))});
        program.dispatch(1);
    }

    /// A work group for each tile of the slice that there is.
    void dispatch(const graph::PassContext& context, const gl::Program& program, graph::Slice slice) const {
        const auto end = std::min(slice.end, tiles_of(items_of(context)));
        if (slice.begin < end) program.dispatch((end - slice.begin) * group_size);
    }
};

graph::BufferRef declare_bases(graph::GraphBuilder& builder, const std::string& key, std::uint64_t items,
                               graph::BufferRef counts) {
    return declare(builder,
                   {.key = key + ".bases",
                    .label = "Sums before tiles",
                    .doc = "For each tile of " + std::to_string(tile_items) +
                           " counts the sum of all counts before it, for " + key + "."},
                   "sum", static_cast<std::uint64_t>(tiles_of(items)), counts);
}

void declare_passes(graph::GraphBuilder& builder, const Scan& scan, graph::CounterRef total) {
    const auto tiles = tiles_of(scan.items);
    builder.pass(scan.key + " sums")
        .reads("Counts", scan.counts)
        .writes("Bases", scan.bases)
        .execute_sliced(
            tiles, [=](graph::PassContext& context, graph::Slice slice) { scan.sum(context, slice); },
            first_slice);
    builder.pass(scan.key + " bases")
        .reads(scan.counts)
        .writes("Bases", scan.bases)
        .counts("Total", total)
        .execute([=](graph::PassContext& context) { scan.add_up(context); });
    // In place, each work group has read its tile before it writes it.
    builder.pass(scan.key + " places")
        .reads("Counts", scan.counts)
        .reads("Bases", scan.bases)
        .writes("Places", scan.places)
        .execute_sliced(
            tiles, [=](graph::PassContext& context, graph::Slice slice) { scan.place(context, slice); },
            first_slice);
}

}  // namespace

graph::BufferRef exclusive_scan(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef counts,
                                std::uint64_t items, graph::CounterRef total) {
    if (items > max_items) throw std::logic_error("scan '" + key + "': more than 2^26 items");
    const auto bases = declare_bases(builder, key, items, counts);
    const auto places = declare(builder,
                                {.key = key + ".places",
                                 .label = "Places",
                                 .doc = "For each item the sum of the counts before it, for " + key + "."},
                                "place", items, counts);
    declare_passes(builder, {key, counts, bases, places, items}, total);
    return places;
}

void scan_in_place(graph::GraphBuilder& builder, const std::string& key, graph::BufferRef words,
                   graph::CounterRef total) {
    const auto bases = declare_bases(builder, key, max_items, words);
    const auto lower = desc_of(builder, words).lower;
    declare_passes(builder, {key, words, bases, words, max_items, lower}, total);
}

}  // namespace ir::passes
