#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/photons/photon_bins.h"
#include "shaders/passes/photons/binned.glsl.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr int rows = 8;  ///< pixels of an invocation; divides gathered_tile
/// Compilers unroll the loop over rows only where it is short; else each entry takes a turn, one for each
/// row, and one that ends the rows.
std::int64_t entries_at_once(const SplatTask& task) {
    return task.photons.looks ? passes::max_turns / (rows + 2) : 49152;
}
constexpr std::uint64_t expected_kernels = 1 << 16;

/// Constants of make_kernels.comp.
struct MakeKernels {
    Footprints footprints;
    unsigned capacity;
    IR_FIELDS(footprints, capacity)
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
        builder, {.photons = task.photons,
                  .bins = passes::photon_bins({view.width, view.height}, passes::gathered_tile),
                  .count_shader = folder + "count_bins.comp",
                  .fill_shader = folder + "fill_bins.comp",
                  .loop_turns = turns_of_box,
                  .declare_reads = [=](graph::PassBuilder& pass) { reads_footprints(pass, task.photons); },
                  .set_constants =
                      [=](const graph::PassContext& p, const gl::Program& program) {
                          program.set(outlines(p.inputs(), task.photons));
                      }});
}

void gather(const graph::PassContext& p, graph::Slice slice, const SplatTask& task,
            const passes::TileGather& tiles) {
    if (slice.first) p.clear(task.irradiance);
    if (slice.first) p.clear(task.direction);
    auto defines = tiles.bins.defines();
    defines["ROWS"] = std::to_string(rows);
    gl::ProgramSource source{{folder + "gather_bins.comp"}, defines};
    define_clipped(source, task.photons);
    const auto& program = p.use(source);
    set_units(p, program, task.photons);
    passes::gather_tiles(p, slice, program, tiles);
}

}  // namespace

void splat_tiles(graph::GraphBuilder& builder, const SplatTask& task) {
    const auto binned = sort_photons(builder, task);
    const auto kernels = make_kernels(builder, task.photons);
    const auto& view = builder.inputs().view;
    const passes::TileGather tiles{.bins = binned.bins,
                                   .photons = task.photons.records,
                                   .size_px = {view.width, view.height},
                                   .entries_at_once = entries_at_once(task),
                                   .rows = rows};
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
    pass.execute_sliced(tiles.tiles(),
                        [=](graph::PassContext& p, graph::Slice slice) { gather(p, slice, task, tiles); });
}

}  // namespace ir::methods::ldm_indirect
