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
    graph::BufferRef photons, sum;
    graph::CounterRef photon_count, sum_count;
};

Explanation declare(graph::GraphBuilder& builder) {
    Explanation e;
    e.photons = builder.output(
        "splat.explain.photons",
        {.fields = record_fields<FoundPhoton>(), .elements = expected_photons, .growable = true});
    e.sum =
        builder.output("splat.explain.sum",
                       {.fields = record_fields<Sum>(), .elements = 1, .growable = true, .cleared = true});
    e.photon_count = builder.counter({.key = "splat.explain.photon_count",
                                      .label = "Photons that light the pixel",
                                      .growth_of = e.photons});
    e.sum_count = builder.counter({.key = "splat.explain.sum_count",
                                   .label = "Pixels explained",
                                   .doc = "0 while no pixel is picked, and where it shows no surface.",
                                   .growth_of = e.sum});
    return e;
}

glm::ivec2 picked_texel(const graph::FrameInputs& inputs, int divisor) {
    const auto pixel = inputs.picked_pixel();
    return pixel.x < 0 ? pixel : pixel / divisor;
}

/// Constants of explain.comp.
struct ExplainPixel {
    KernelRules rules;
    glm::ivec2 picked_texel;
    IR_FIELDS(rules, picked_texel)
};

void gather(const graph::PassContext& p, graph::Slice slice, const Kernels& kernels) {
    gl::ProgramSource source{{"methods/photon-mapping/splatting/explain.comp"}};
    source.defines = kernel_defines(kernels);
    const auto& program = p.use(source);
    program.set(ExplainPixel{kernel_rules(p.inputs(), kernels.parameters, kernels.photons.power_unit),
                             picked_texel(p.inputs(), kernels.surfaces.divisor)});
    dispatch_photons(p, program, kernels.photons, slice);
}

/// The largest contribution first, equal ones in the order of the photons.
bool comes_before(const FoundPhoton& a, const FoundPhoton& b) {
    const auto total = [](const FoundPhoton& p) {
        return double(p.contribution[0]) + p.contribution[1] + p.contribution[2];
    };
    return total(a) != total(b) ? total(a) > total(b) : a.photon < b.photon;
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
    const auto sums = p.elements<Sum>(e.sum);
    const auto photons = p.elements<FoundPhoton>(e.photons);
    if (sums.empty()) return;
    const auto found = photons.first(std::min<std::size_t>(photons.size(), sums[0].photons));
    std::sort(found.begin(), found.end(), comes_before);
    const auto texel = picked_texel(p.inputs(), kernels.surfaces.divisor);
    sums[0].texel_x = static_cast<std::uint32_t>(texel.x);
    sums[0].texel_y = static_cast<std::uint32_t>(texel.y);
    add_up(found, sums[0]);
}

}  // namespace

void explain_pixel(graph::GraphBuilder& builder, const Kernels& kernels, graph::ImageRef irradiance) {
    const auto e = declare(builder);
    builder.pass("explain photons of the pixel")
        .reads("Photons", kernels.photons.records)
        .reads("Stored", kernels.photons.stored)
        .reads("tiles", kernels.tiles)
        .reads("surfaces", kernels.surfaces.surfaces)
        .reads("irradiance", irradiance)
        .writes("FoundPhotons", e.photons)
        .writes("PixelSum", e.sum)
        .counts("PhotonCount", e.photon_count)
        .counts("SumCount", e.sum_count)
        .execute_sliced(photon_parts,
                        [=](graph::PassContext& p, graph::Slice slice) { gather(p, slice, kernels); });
    builder.pass("sort photons of the pixel", graph::Queue::cpu)
        .reads(e.photons, e.sum)
        .writes(e.photons, e.sum)
        .execute([=](graph::PassContext& p) { sort_and_add_up(p, kernels, e); });
}

}  // namespace ir::methods::photon_mapping
