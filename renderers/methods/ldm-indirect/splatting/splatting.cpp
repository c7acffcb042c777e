#include "renderers/methods/ldm-indirect/stages.h"

#include "renderers/methods/ldm-indirect/splatting/stored.h"

namespace ir::methods::ldm_indirect {

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
    switch (parameters.splatting) {
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
    return {task.irradiance, task.photons.stored, task.photons.arrivals};
}

}  // namespace ir::methods::ldm_indirect
