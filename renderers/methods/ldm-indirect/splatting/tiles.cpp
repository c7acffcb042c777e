#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/photons/photon_bins.h"
#include "shaders/methods/ldm-indirect/splatting/gather_bins.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr int tile = gathered_tile;
constexpr int rows = 8;  ///< pixels of an invocation; divides tile
/// Entries of a list that one dispatch sums. Compilers unroll the loop over rows only where it is short; else
/// each entry takes a turn, one for each row, and one that ends the rows.
std::int64_t round_size(const SplatTask& task) {
    return task.photons.looks ? passes::max_turns / (rows + 2) : 49152;
}
constexpr std::uint64_t expected_kernels = 1 << 16;

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

graph::BufferRef make_kernels(graph::GraphBuilder& builder, const StoredPhotons& photons) {
    const auto kernels = builder.buffer(
        {.text = {.key = "splat.kernels",
                  .label = "Kernels of photons",
                  .doc = "Place and filter of each photon as tiles read them: centre, three rows of M, E_p "
                         "π; to_source and 1 over the cosine to it in w."},
         .fields = {{"rows", graph::FieldType::f32, 20}},
         .elements = expected_kernels,
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

passes::BinnedPhotons sort_photons(graph::GraphBuilder& builder, const SplatTask& task) {
    const auto& view = builder.inputs().view;
    constexpr int turns_of_box = 40;  // of clipped_box()
    return passes::sort_into_bins(
        builder,
        {.photons = task.photons,
         .bins = passes::photon_bins({view.width, view.height}, tile),
         .counts = folder + "count_bins.comp",
         .lists = folder + "fill_bins.comp",
         .turns = turns_of_box,
         .reads = [=](graph::PassBuilder& pass) { reads_footprints(pass, task.photons); },
         .set = [=](const graph::PassContext& p,
                    const gl::Program& program) { program.set(outlines(p.inputs(), task.photons)); }});
}

void gather(const graph::PassContext& p, graph::Slice slice, const SplatTask& task,
            const passes::PhotonBins& bins, int tiles_across) {
    if (slice.first) p.clear(task.irradiance);
    if (slice.first) p.clear(task.direction);
    auto defines = bins.defines();
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
                               .bins_across = static_cast<unsigned>(bins.across),
                               .first_tile = static_cast<unsigned>(slice.begin),
                               .round_first = static_cast<unsigned>(first),
                               .round_size = static_cast<unsigned>(round)});
        program.dispatch((slice.end - slice.begin) * tile, tile / rows);
        p.barrier();
    }
}

}  // namespace

void splat_tiles(graph::GraphBuilder& builder, const SplatTask& task) {
    const auto binned = sort_photons(builder, task);
    const auto kernels = make_kernels(builder, task.photons);
    const auto& view = builder.inputs().view;
    const int across = (view.width + tile - 1) / tile, down = (view.height + tile - 1) / tile;
    auto pass = builder.pass("gather photons of tiles");
    pass.has_two_bodies()
        .reads(task.photons.records, task.position, task.normal)
        .reads("Stored", task.photons.stored)
        .reads("Arrivals", task.photons.arrivals)
        .reads("Places", binned.places)
        .reads("Lists", binned.entries)
        .reads("Kernels", kernels)
        .writes("sums", task.irradiance)
        .writes("directions", task.direction);
    reads_looks(pass, task.photons);
    pass.execute_sliced(std::int64_t{across} * down, [=](graph::PassContext& p, graph::Slice slice) {
        gather(p, slice, task, binned.bins, across);
    });
}

}  // namespace ir::methods::ldm_indirect
