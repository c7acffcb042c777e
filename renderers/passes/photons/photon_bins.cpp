#include "renderers/passes/photons/photon_bins.h"

#include "renderers/passes/scan/scan.h"
#include "shaders/passes/photons/binned.glsl.h"

namespace ir::passes {
namespace {

constexpr unsigned columns = 1024;  ///< parts of the photons that are sorted side by side
constexpr int max_bins = 4096;      ///< so that counts take 16 MiB at most
constexpr std::uint64_t expected_entries = 1 << 16;

/// Constants of bins.glsl.
struct SortIntoBins {
    unsigned bins_across, first_of_column, end_of_column;
    IR_FIELDS(bins_across, first_of_column, end_of_column)
};

/// Constants of binned.glsl.
struct GatherTiles {
    unsigned bins_across, tiles_across, first_tile, round_first, round_size;
    IR_FIELDS(bins_across, tiles_across, first_tile, round_first, round_size)
};

glm::ivec2 tiles_of(glm::ivec2 size_px) {
    constexpr int tile = gathered_tile;
    return (size_px + tile - 1) / tile;
}

/// Runs a program for the slice's photons of each column.
void sort(const graph::PassContext& p, graph::Slice slice, const PhotonBinning& binning,
          const std::string& file) {
    auto defines = binning.bins.defines();
    defines.insert(binning.defines.begin(), binning.defines.end());
    const auto& program = p.use({{file}, defines});
    binning.set_constants(p, program);
    const auto capacity = static_cast<std::int64_t>(p.capacity(binning.photons.records));
    const std::int64_t per_column = (capacity + columns - 1) / columns;
    const auto end = per_column * slice.end / photon_parts;
    // of a photon: bins, rows of them, each with a turn that ends it, and what finding its pixels takes
    const auto turns = binning.bins.count() + 2 * binning.bins.down + 4 + binning.loop_turns;
    const auto step = std::max<std::int64_t>(1, max_turns / turns);
    for (auto first = per_column * slice.begin / photon_parts; first < end; first += step) {
        program.set(SortIntoBins{.bins_across = static_cast<unsigned>(binning.bins.across),
                                 .first_of_column = static_cast<unsigned>(first),
                                 .end_of_column = static_cast<unsigned>(std::min(end, first + step))});
        program.dispatch(columns);
        p.barrier();
    }
}

}  // namespace

std::map<std::string, std::string> PhotonBins::defines() const {
    return {{"BIN", std::to_string(side) + "u"}, {"COLUMNS", std::to_string(columns) + "u"}};
}

PhotonBins photon_bins(glm::ivec2 size_px, int tile) {
    for (int side = tile;; side *= 2) {
        const PhotonBins bins{side, (size_px.x + side - 1) / side, (size_px.y + side - 1) / side};
        if (bins.count() <= max_bins) return bins;
    }
}

BinnedPhotons sort_into_bins(graph::GraphBuilder& builder, const PhotonBinning& binning) {
    using graph::FieldType;
    BinnedPhotons result{.bins = binning.bins, .places = {}, .entries = {}};
    const auto slots = static_cast<std::uint64_t>(binning.bins.count()) * columns;
    const auto counts = builder.buffer({.text = {.key = "splat.bin_counts",
                                                 .label = "Photons by tile and part",
                                                 .doc = "How many photons of each 1024th of the buffer are "
                                                        "seen in each tile."},
                                        .fields = {{"photons", FieldType::u32}},
                                        .elements = slots,
                                        .cleared = true});
    auto count = builder.pass("count photons of bins");
    binning.declare_reads(count);
    count.writes("Counts", counts)
        .execute_sliced(photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            sort(p, slice, binning, binning.count_shader);
        });
    result.entries = builder.buffer({.text = {.key = "splat.bin_lists",
                                              .label = "Photons of the tiles",
                                              .doc = "Numbers of photons, tile after tile, each in order."},
                                     .fields = {{"photon", FieldType::u32}},
                                     .elements = expected_entries,
                                     .growable = true});
    const auto total = builder.counter({.key = "splat.bin_entries",
                                        .label = "Photons times tiles",
                                        .doc = "How often photons are listed in tiles.",
                                        .growth_of = result.entries});
    result.places = exclusive_scan(builder, "splat.bins", counts, slots, total);
    auto list = builder.pass("list photons of bins");
    binning.declare_reads(list);
    list.writes("Places", result.places)
        .writes("Lists", result.entries)
        .execute_sliced(photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            sort(p, slice, binning, binning.fill_shader);
        });
    return result;
}

std::int64_t TileGather::tiles() const {
    const auto tiles = tiles_of(size_px);
    return std::int64_t{tiles.x} * tiles.y;
}

void gather_tiles(const graph::PassContext& p, graph::Slice slice, const gl::Program& program,
                  const TileGather& gather) {
    // a photon stands once in a list, so that no list is longer than there are photons
    const auto longest = static_cast<std::int64_t>(p.capacity(gather.photons));
    for (std::int64_t first = 0; first < longest; first += gather.entries_at_once) {
        program.set(GatherTiles{.bins_across = static_cast<unsigned>(gather.bins.across),
                                .tiles_across = static_cast<unsigned>(tiles_of(gather.size_px).x),
                                .first_tile = static_cast<unsigned>(slice.begin),
                                .round_first = static_cast<unsigned>(first),
                                .round_size = static_cast<unsigned>(gather.entries_at_once)});
        program.dispatch((slice.end - slice.begin) * gathered_tile, gathered_tile / gather.rows);
        p.barrier();
    }
}

}  // namespace ir::passes
