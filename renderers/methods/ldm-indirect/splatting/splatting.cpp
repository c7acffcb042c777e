#include "renderers/methods/ldm-indirect/stages.h"

#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {

namespace {

void splat_on_device(graph::GraphBuilder& builder, const SplatTask& task) {
    measure_footprints(builder, task.photons);
    switch (task.photons.parameters.splatting) {
        case Splatting::quads:
            splat_quads(builder, task);
            break;
        case Splatting::tiles:
            splat_tiles(builder, task);
            break;
        case Splatting::image_atomics:
            splat_image_atomics(builder, task);
            break;
    }
}

}  // namespace

void reads_task(graph::PassBuilder& pass, const SplatTask& task) {
    reads_footprints(pass, task.photons);
    pass.reads(task.position, task.normal);
}

Splat splat_photons(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer, const Photons& photons,
                    const Parameters& parameters) {
    SplatTask task;
    task.photons = stored_photons(builder, photons, parameters);
    task.position = gbuffer.position;
    task.normal = gbuffer.geometric_normal;
    task.irradiance = builder.output("indirect.irradiance", {.format = gl::Format::rgba32f});
    task.direction = builder.output("indirect.direction", {.format = gl::Format::rgba32f});
    const bool on_host =
        builder.inputs().processor == Processor::host && parameters.splatting == Splatting::tiles;
    if (on_host)
        splat_on_host(builder, gbuffer, task);
    else
        splat_on_device(builder, task);
    return {task.irradiance, task.direction, task.photons.stored, task.photons.arrivals};
}

}  // namespace ir::methods::ldm_indirect
