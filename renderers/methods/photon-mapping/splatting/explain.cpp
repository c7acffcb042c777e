#include "renderers/methods/photon-mapping/splatting/stages.h"

#include <algorithm>
#include <array>
#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "shaders/methods/photon-mapping/splatting/explain.comp.h"

namespace ir::methods::photon_mapping {
namespace {

/// Kernels that cover a texel are expected to be no more than this at first.
constexpr std::uint64_t expected_photons = 1024;

/// As the buffer PixelSum of explain.comp, which writes photons and pixel.
struct Sum {
    std::uint32_t texel_x, texel_y, photons;
    std::array<float, 3> gathered, pixel, difference;
    IR_FIELDS(texel_x, texel_y, photons, gathered, pixel, difference)
};

/// Both are first what the device found, and then what the host made of it: buffers of their own in between
/// would be kept where their keys are asked for, and the explanation of another pixel would find them done.
struct Explanation {
    graph::CountedBuffer photons, sum;
};

Explanation declare(graph::GraphBuilder& builder) {
    return {
        .photons = builder.explanation("splat.explain.photons",
                                       {.fields = record_fields<FoundPhoton>(), .elements = expected_photons},
                                       {.key = "splat.explain.photon_count"}),
        .sum = builder.explanation("splat.explain.sum",
                                   {.fields = record_fields<Sum>(), .elements = 1, .cleared = true},
                                   {.key = "splat.explain.sum_count", .label = "Pixels explained"})};
}

/// Constants of explain.comp.
struct ExplainPixel {
    KernelRules rules;
    glm::ivec2 picked_texel;
    IR_FIELDS(rules, picked_texel)
};

void gather(const graph::PassContext& p, graph::Slice slice, const Kernels& kernels) {
    gl::ProgramSource source{{"methods/photon-mapping/splatting/explain.comp"}, kernel_defines(kernels)};
    define_reflection(source, kernels);
    const auto& program = p.use(source);
    set_reflection(program, kernels);
    program.set(ExplainPixel{kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit),
                             picked_texel(p.inputs(), kernels.surfaces.divisor)});
    passes::dispatch_photons(p, program, kernels.photons, slice);
}

void add_up(std::span<const FoundPhoton> photons, Sum& sum) {
    for (std::size_t c = 0; c < 3; ++c) {
        double gathered = 0;
        for (const auto& photon : photons) gathered += photon.contribution[c];
        sum.gathered[c] = static_cast<float>(gathered);
        sum.difference[c] = static_cast<float>(sum.pixel[c] - gathered);
    }
}

void sort_and_add_up(const graph::PassContext& p, const Kernels& kernels, const Explanation& e) {
    const auto sums = p.elements<Sum>(e.sum.elements);
    const auto photons = p.elements<FoundPhoton>(e.photons.elements);
    if (sums.empty()) return;
    const auto found = photons.first(std::min<std::size_t>(photons.size(), sums[0].photons));
    passes::sort_found(found);
    for (std::size_t i = 0; i < found.size(); ++i) found[i].path = static_cast<std::uint32_t>(i);
    const auto texel = picked_texel(p.inputs(), kernels.surfaces.divisor);
    sums[0].texel_x = static_cast<std::uint32_t>(texel.x);
    sums[0].texel_y = static_cast<std::uint32_t>(texel.y);
    add_up(found, sums[0]);
}

}  // namespace

void explain_pixel(graph::GraphBuilder& builder, const Kernels& kernels, Splat& splat) {
    const auto e = declare(builder);
    auto pass = builder.pass("explain photons of the pixel");
    reads_receivers(pass, kernels);
    pass.reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("depths", kernels.surfaces.depth)
        .reads("irradiance", splat.irradiance)
        .writes("FoundPhotons", e.photons.elements)
        .writes("PixelSum", e.sum.elements)
        .counts("PhotonCount", e.photons.count)
        .counts("SumCount", e.sum.count)
        .execute_sliced(passes::photon_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { gather(p, slice, kernels); });
    builder.pass("sort photons of the pixel", graph::Queue::cpu)
        .reads(e.photons.elements, e.sum.elements)
        .writes(e.photons.elements, e.sum.elements)
        .execute([=](graph::PassContext& p) { sort_and_add_up(p, kernels, e); });
    splat.found = e.photons.elements;
    splat.sum = e.sum.elements;
}

std::span<const FoundPhoton> found_photons(const graph::PassContext& p, const Splat& splat) {
    const auto photons = p.elements<const FoundPhoton>(splat.found);
    const auto sums = p.elements<const Sum>(splat.sum);
    return photons.first(sums.empty() ? 0 : std::min<std::size_t>(photons.size(), sums[0].photons));
}

}  // namespace ir::methods::photon_mapping
