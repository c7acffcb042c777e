#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"
#include "shaders/methods/photon-mapping/splatting/show_kernels.comp.h"

namespace ir::methods::photon_mapping {
namespace {

constexpr std::uint64_t expected_kernels = 1 << 14;

/// Constants of show_kernels.comp.
struct ShowKernels {
    KernelRules rules;
    glm::ivec2 picked_texel;
    IR_FIELDS(rules, picked_texel)
};

}  // namespace

void show_kernels(graph::GraphBuilder& builder, const Kernels& kernels) {
    const auto shown = builder.output(
        "splat.kernels",
        {.fields = record_fields<ShownKernel>(), .elements = expected_kernels, .growable = true});
    const auto count =
        builder.counter({.key = "splat.kernel_count", .label = "Kernels shown", .growth_of = shown});
    auto pass = builder.pass("show kernels");
    if (kernels.parameters.facing_test) pass.reads(kernels.surfaces.gbuffer.geometric_normal);
    pass.reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("depths", kernels.surfaces.depth)
        .writes("ShownKernels", shown)
        .counts("KernelCount", count)
        .execute_sliced(passes::photon_parts, [=](graph::PassContext& p, graph::Slice slice) {
            gl::ProgramSource source{{"methods/photon-mapping/splatting/show_kernels.comp"}};
            source.defines = kernel_defines(kernels);
            const auto& program = p.use(source);
            program.set(ShowKernels{kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit),
                                    picked_texel(p.inputs(), kernels.surfaces.divisor)});
            passes::dispatch_photons(p, program, kernels.photons, slice);
        });
}

}  // namespace ir::methods::photon_mapping
