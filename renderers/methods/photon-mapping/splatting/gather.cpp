#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "renderers/passes/photons/photon_bins.h"
#include "shaders/passes/photons/binned.glsl.h"

namespace ir::methods::photon_mapping {
namespace {

/// Each takes a turn, and a few more end the batches.
constexpr std::int64_t entries_at_once = 49152;

KernelRules rules_of(const graph::PassContext& p, const Kernels& kernels) {
    return kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit);
}

/// By their outlines, which do not depend on how bright they are.
passes::BinnedPhotons sort_kernels(graph::GraphBuilder& builder, const Kernels& kernels, glm::ivec2 size) {
    auto defines = kernel_defines(kernels);
    defines.erase("EDGE_PROBES");
    return passes::sort_into_bins(
        builder, {.photons = kernels.photons,
                  .bins = passes::photon_bins(size, passes::gathered_tile),
                  .count_shader = "methods/photon-mapping/splatting/count_bins.comp",
                  .fill_shader = "methods/photon-mapping/splatting/fill_bins.comp",
                  .defines = defines,
                  .declare_reads =
                      [=](graph::PassBuilder& pass) {
                          pass.reads("Photons", kernels.photons.records)
                              .reads("Stored", kernels.photons.stored)
                              .reads("tiles", kernels.tiles);
                      },
                  .set_constants = [=](const graph::PassContext& p,
                                       const gl::Program& program) { program.set(rules_of(p, kernels)); }});
}

void gather(const graph::PassContext& p, graph::Slice slice, const Kernels& kernels, const KernelPass& pass,
            const passes::TileGather& tiles) {
    if (slice.first)
        for (const auto target : pass.targets) p.clear(target);
    const bool half = kernels.parameters.has_half_sums();
    gl::ProgramSource source{{"methods/photon-mapping/splatting/gather_bins.comp"}, kernel_defines(kernels)};
    source.defines.merge(tiles.bins.defines());
    source.defines["SUMS"] = half ? "rgba16f" : "rgba32f";
    source.defines["DIRECTIONS"] = half ? "rg16f" : "rg32f";
    define_reflection(source, kernels);
    const auto& program = p.use(source);
    program.set(rules_of(p, kernels));
    set_reflection(program, kernels);
    passes::gather_tiles(p, slice, program, tiles);
}

}  // namespace

void define_reflection(gl::ProgramSource& source, const Kernels& kernels) {
    if (!kernels.parameters.reflects_each_photon()) return;
    source.defines["REFLECTS"] = "1";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(kernels.parameters.transport.materials));
}

void reads_receivers(graph::PassBuilder& pass, const Kernels& kernels) {
    const auto& gbuffer = kernels.surfaces.gbuffer;
    const bool reflects = kernels.parameters.reflects_each_photon();
    if (reflects || kernels.parameters.facing_test) pass.reads(gbuffer.geometric_normal);
    if (reflects)
        pass.reads(gbuffer.albedo, gbuffer.material, gbuffer.normal, kernels.surfaces.scene.materials);
}

void set_reflection(const gl::Program& program, const Kernels& kernels) {
    const auto& parameters = kernels.parameters;
    if (parameters.reflects_each_photon())
        program.set(passes::DirectionalConstants{parameters.max_stretch, parameters.receivers.directional});
}

void gather_kernels(graph::GraphBuilder& builder, const Kernels& kernels, const KernelPass& pass) {
    const auto size = texels_of(builder.inputs().view, kernels.surfaces.divisor);
    const auto binned = sort_kernels(builder, kernels, size);
    const passes::TileGather tiles{.bins = binned.bins,
                                   .photons = kernels.photons.records,
                                   .size_px = size,
                                   .entries_at_once = entries_at_once};
    auto declared = builder.pass(pass.name);
    if (pass.has_two_bodies) declared.has_two_bodies();
    reads_receivers(declared, kernels);
    declared.reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("depths", kernels.surfaces.depth)
        .reads("Places", binned.places)
        .reads("Lists", binned.entries)
        .writes("sums", pass.targets[0])
        .writes("directions", pass.targets[1])
        .execute_sliced(tiles.tiles(), [=](graph::PassContext& p, graph::Slice slice) {
            gather(p, slice, kernels, pass, tiles);
        });
}

}  // namespace ir::methods::photon_mapping
