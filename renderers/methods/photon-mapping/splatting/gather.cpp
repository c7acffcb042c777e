#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "renderers/passes/photons/photon_bins.h"
#include "shaders/methods/photon-mapping/splatting/gather_bins.comp.h"

namespace ir::methods::photon_mapping {
namespace {

constexpr int tile = gathered_tile;
/// Entries of a list that one dispatch sums: each takes a turn, and a few more end the batches.
constexpr std::int64_t round_size = 49152;

/// Constants of gather_bins.comp.
struct GatherBins {
    KernelRules rules;
    unsigned tiles_across, bins_across, first_tile, round_first, round_size;
    IR_FIELDS(rules, tiles_across, bins_across, first_tile, round_first, round_size)
};

KernelRules rules_of(const graph::PassContext& p, const Kernels& kernels) {
    return kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit);
}

/// By their outlines, which do not depend on how bright they are.
passes::BinnedPhotons sort_kernels(graph::GraphBuilder& builder, const Kernels& kernels, glm::ivec2 size) {
    auto defines = kernel_defines(kernels);
    defines.erase("EDGE_PROBES");
    return passes::sort_into_bins(
        builder, {.photons = kernels.photons,
                  .bins = passes::photon_bins(size, tile),
                  .counts = "methods/photon-mapping/splatting/count_bins.comp",
                  .lists = "methods/photon-mapping/splatting/fill_bins.comp",
                  .defines = defines,
                  .reads =
                      [=](graph::PassBuilder& pass) {
                          pass.reads("Photons", kernels.photons.records)
                              .reads("Stored", kernels.photons.stored)
                              .reads("tiles", kernels.tiles);
                      },
                  .set = [=](const graph::PassContext& p,
                             const gl::Program& program) { program.set(rules_of(p, kernels)); }});
}

void gather(const graph::PassContext& p, graph::Slice slice, const Kernels& kernels, const KernelPass& pass,
            const passes::PhotonBins& bins, int tiles_across) {
    if (slice.first)
        for (const auto target : pass.targets) p.clear(target);
    const bool half = kernels.parameters.has_half_sums();
    gl::ProgramSource source{{"methods/photon-mapping/splatting/gather_bins.comp"}, kernel_defines(kernels)};
    source.defines.merge(bins.defines());
    source.defines["SUMS"] = half ? "rgba16f" : "rgba32f";
    source.defines["DIRECTIONS"] = half ? "rg16f" : "rg32f";
    const auto& program = p.use(source);
    // a photon stands once in a list, so that no list is longer than there are photons
    const auto longest = static_cast<std::int64_t>(p.capacity(kernels.photons.records));
    for (std::int64_t first = 0; first < longest; first += round_size) {
        program.set(GatherBins{.rules = rules_of(p, kernels),
                               .tiles_across = static_cast<unsigned>(tiles_across),
                               .bins_across = static_cast<unsigned>(bins.across),
                               .first_tile = static_cast<unsigned>(slice.begin),
                               .round_first = static_cast<unsigned>(first),
                               .round_size = static_cast<unsigned>(round_size)});
        program.dispatch((slice.end - slice.begin) * tile, tile);
        p.barrier();
    }
}

}  // namespace

void gather_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass) {
    const auto size = texels_of(builder.inputs().view, kernels.surfaces.divisor);
    const auto binned = sort_kernels(builder, kernels, size);
    const auto tiles = (size + tile - 1) / tile;
    auto declared = builder.pass(pass.name);
    if (kernels.parameters.facing_test) declared.reads(kernels.surfaces.geometric_normal);
    declared.reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("depths", kernels.surfaces.depth)
        .reads("Places", binned.places)
        .reads("Lists", binned.entries)
        .writes("sums", pass.targets[0])
        .writes("directions", pass.targets[1])
        .execute_sliced(std::int64_t{tiles.x} * tiles.y, [=](graph::PassContext& p, graph::Slice slice) {
            gather(p, slice, kernels, pass, binned.bins, tiles.x);
        });
}

}  // namespace ir::methods::photon_mapping
