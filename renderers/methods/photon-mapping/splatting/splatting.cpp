#include "renderers/methods/photon-mapping/stages.h"

#include "renderers/methods/photon-mapping/splatting/splat_view.h"
#include "renderers/methods/photon-mapping/splatting/stages.h"

namespace ir::methods::photon_mapping {
namespace {

graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key, gl::Format format,
                        int divisor) {
    return builder.output(
        key, {.format = format, .extent = graph::Extent::view(1.0f / static_cast<float>(divisor))});
}

}  // namespace

Splat splat_photons(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                    const passes::GBuffer& gbuffer, const Photons& photons, const Parameters& parameters) {
    const int divisor = divisor_of(parameters.splat_resolution);
    const bool half = parameters.has_half_sums();
    const auto stored = stored_photons(builder, photons);
    const auto tiles = count_tiles(builder, stored, parameters);
    const auto surfaces = splat_surfaces(builder, scene, gbuffer, divisor);
    const auto kernels = declare_kernels(builder, stored, tiles, surfaces, parameters);

    Splat splat;
    splat.divisor = divisor;
    splat.irradiance =
        declare(builder, "splat.irradiance", half ? gl::Format::rgba16f : gl::Format::rgba32f, divisor);
    splat.direction =
        declare(builder, "splat.direction", half ? gl::Format::rg16f : gl::Format::rg32f, divisor);
    const KernelPass sums{.name = "splat photons",
                          .command_key = "splat.command",
                          .targets = {splat.irradiance, splat.direction},
                          .has_two_bodies = parameters.splatting == Splatting::drawn &&
                                            parameters.inside_test == InsideTest::ellipsoid};
    if (sums.has_two_bodies && builder.inputs().processor == Processor::host)
        splat_on_host(builder, kernels, sums);
    else if (parameters.splatting == Splatting::tiles || parameters.reflects_each_photon())
        gather_kernels(builder, kernels, sums);
    else
        draw_kernels(builder, kernels, sums);
    draw_kernels(builder, kernels,
                 {.name = "count kernels",
                  .command_key = "splat.count_command",
                  .targets = {declare(builder, "splat.count", gl::Format::r32f, divisor)},
                  .defines = {{"COUNT", "1"}},
                  .depth_test = false});
    draw_overlay(builder, gbuffer, stored);
    explain_pixel(builder, kernels, splat);
    show_kernels(builder, kernels);
    return splat;
}

}  // namespace ir::methods::photon_mapping
