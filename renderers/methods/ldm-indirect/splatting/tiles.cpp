#include <algorithm>

#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/scan/scan.h"
#include "shaders/methods/ldm-indirect/splatting/gather_bins.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr int tile = gathered_tile;
constexpr int rows = 8;                    ///< pixels of an invocation; divides tile
constexpr unsigned columns = 1024;         ///< parts of the photons that are binned side by side
constexpr int max_bins = 4096;             ///< so that counts take 16 MiB at most
constexpr std::int64_t max_turns = 60000;  ///< llvmpipe ends all loops of an invocation after 65,535
/// Entries of a list that one dispatch sums. Compilers unroll the loop over rows only where it is short; else
/// each entry takes a turn, one for each row, and one that ends the rows.
std::int64_t round_size(const SplatTask& task) {
    return task.photons.looks ? max_turns / (rows + 2) : 49152;
}
constexpr std::uint64_t expected_entries = 1 << 16;

/// Squares of the picture: tiles of 16 pixels, or so many more that there are not too many of them.
struct Bins {
    int side = tile, across = 1, down = 1;
    int count() const { return across * down; }
};

Bins bins_of(const scene::View& view) {
    Bins bins;
    for (bins.side = tile;; bins.side *= 2) {
        bins.across = (view.width + bins.side - 1) / bins.side;
        bins.down = (view.height + bins.side - 1) / bins.side;
        if (bins.count() <= max_bins) return bins;
    }
}

struct Lists {
    graph::BufferRef counts, places, entries, kernels;
    Bins bins;
};

std::map<std::string, std::string> defines_of(const Bins& bins) {
    return {{"BIN", std::to_string(bins.side) + "u"}, {"COLUMNS", std::to_string(columns) + "u"}};
}

/// Constants of bins.glsl and what it includes.
struct SortIntoBins {
    Outlines outlines;
    unsigned bins_across, first_of_column, end_of_column;
    IR_FIELDS(outlines, bins_across, first_of_column, end_of_column)
};

/// Constants of make_kernels.comp.
struct MakeKernels {
    Footprints footprints;
    unsigned capacity;
    IR_FIELDS(footprints, capacity)
};

/// Constants of gather_bins.comp.
struct GatherBins {
    unsigned tiles_across, bins_across, first_tile, round_first, round_size;
    IR_FIELDS(tiles_across, bins_across, first_tile, round_first, round_size)
};

/// Runs a program of bins.glsl for the slice's photons of each column.
void bin(const graph::PassContext& p, graph::Slice slice, const SplatTask& task, const Lists& lists,
         const std::string& file) {
    const auto& program = p.use({{folder + file}, defines_of(lists.bins)});
    SortIntoBins constants{.outlines = outlines(p.inputs(), task.photons),
                           .bins_across = static_cast<unsigned>(lists.bins.across),
                           .first_of_column = 0,
                           .end_of_column = 0};
    const auto capacity = static_cast<std::int64_t>(p.capacity(task.photons.records));
    const std::int64_t per_column = (capacity + columns - 1) / columns;
    const auto end = per_column * slice.end / passes::photon_parts;
    // of a photon: rows of bins, bins in them, each with a turn that ends them, and what clipped_box() takes
    const auto turns = lists.bins.count() + 2 * lists.bins.down + 44;
    const auto step = std::max<std::int64_t>(1, max_turns / turns);
    for (auto first = per_column * slice.begin / passes::photon_parts; first < end; first += step) {
        constants.first_of_column = static_cast<unsigned>(first);
        constants.end_of_column = static_cast<unsigned>(std::min(end, first + step));
        program.set(constants);
        program.dispatch(columns);
        p.barrier();
    }
}

graph::BufferRef make_kernels(graph::GraphBuilder& builder, const StoredPhotons& photons) {
    const auto kernels = builder.buffer(
        {.text = {.key = "splat.kernels",
                  .label = "Kernels of photons",
                  .doc = "Place and filter of each photon as tiles read them: centre, three rows of M, E_p "
                         "π; to_source and 1 over the cosine to it in w."},
         .fields = {{"rows", graph::FieldType::f32, 20}},
         .elements = expected_entries,
         .growable = true});
    const auto count = builder.counter({.key = "splat.kernel_count",
                                        .label = "Kernels",
                                        .doc = "As many as there are photons.",
                                        .growth_of = kernels});
    auto pass = builder.pass("make kernels");
    reads_footprints(pass, photons);
    pass.counts("Count", photons.count).counts("KernelCount", count).writes("Kernels", kernels);
    pass.execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
        const auto& program = p.use({{folder + "make_kernels.comp"}});
        program.set(MakeKernels{footprints(p.inputs(), photons), static_cast<unsigned>(p.capacity(kernels))});
        passes::dispatch_photons(p, program, photons, slice);
    });
    return kernels;
}

Lists sort_into_bins(graph::GraphBuilder& builder, const SplatTask& task) {
    using graph::FieldType;
    Lists lists;
    lists.bins = bins_of(builder.inputs().view);
    const auto slots = static_cast<std::uint64_t>(lists.bins.count()) * columns;
    lists.counts = builder.buffer({.text = {.key = "splat.bin_counts",
                                            .label = "Photons by tile and part",
                                            .doc = "How many photons of each 1024th of the buffer are seen "
                                                   "in each tile."},
                                   .fields = {{"photons", FieldType::u32}},
                                   .elements = slots,
                                   .cleared = true});
    auto count = builder.pass("count photons of tiles");
    reads_footprints(count, task.photons);
    count.writes("Counts", lists.counts)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            bin(p, slice, task, lists, "count_bins.comp");
        });
    lists.entries = builder.buffer({.text = {.key = "splat.bin_lists",
                                             .label = "Photons of the tiles",
                                             .doc = "Numbers of photons, tile after tile, each in order."},
                                    .fields = {{"photon", FieldType::u32}},
                                    .elements = expected_entries,
                                    .growable = true});
    const auto total = builder.counter({.key = "splat.bin_entries",
                                        .label = "Photons times tiles",
                                        .doc = "How often photons are listed in tiles.",
                                        .growth_of = lists.entries});
    lists.places = passes::exclusive_scan(builder, "splat.bins", lists.counts, slots, total);
    auto fill = builder.pass("list photons of tiles");
    reads_footprints(fill, task.photons);
    fill.writes("Places", lists.places)
        .writes("Lists", lists.entries)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            bin(p, slice, task, lists, "fill_bins.comp");
        });
    return lists;
}

void gather(const graph::PassContext& p, graph::Slice slice, const SplatTask& task, const Lists& lists,
            int tiles_across) {
    if (slice.first) p.clear(task.irradiance);
    if (slice.first) p.clear(task.direction);
    auto defines = defines_of(lists.bins);
    defines["ROWS"] = std::to_string(rows);
    gl::ProgramSource source{{folder + "gather_bins.comp"}, defines};
    define_clipped(source, task.photons);
    const auto& program = p.use(source);
    set_units(p, program, task.photons);
    // a photon stands once in a list, so that no list is longer than there are photons
    const auto longest = static_cast<std::int64_t>(p.capacity(task.photons.records));
    const auto round = round_size(task);
    for (std::int64_t first = 0; first < longest; first += round) {
        program.set(GatherBins{.tiles_across = static_cast<unsigned>(tiles_across),
                               .bins_across = static_cast<unsigned>(lists.bins.across),
                               .first_tile = static_cast<unsigned>(slice.begin),
                               .round_first = static_cast<unsigned>(first),
                               .round_size = static_cast<unsigned>(round)});
        program.dispatch((slice.end - slice.begin) * tile, tile / rows);
        p.barrier();
    }
}

}  // namespace

void splat_tiles(graph::GraphBuilder& builder, const SplatTask& task) {
    auto lists = sort_into_bins(builder, task);
    lists.kernels = make_kernels(builder, task.photons);
    const auto& view = builder.inputs().view;
    const int across = (view.width + tile - 1) / tile, down = (view.height + tile - 1) / tile;
    auto pass = builder.pass("gather photons of tiles");
    pass.has_two_bodies()
        .reads(task.photons.records, task.position, task.normal)
        .reads("Stored", task.photons.stored)
        .reads("Arrivals", task.photons.arrivals)
        .reads("Places", lists.places)
        .reads("Lists", lists.entries)
        .reads("Kernels", lists.kernels)
        .writes("sums", task.irradiance)
        .writes("directions", task.direction);
    reads_looks(pass, task.photons);
    pass.execute_sliced(std::int64_t{across} * down, [=](graph::PassContext& p, graph::Slice slice) {
        gather(p, slice, task, lists, across);
    });
}

}  // namespace ir::methods::ldm_indirect
