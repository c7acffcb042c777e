#include "renderers/methods/ldm-indirect/stages.h"

#include "renderers/graph/pass_context.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/passes/scene/stands_still.h"

namespace ir::methods::ldm_indirect {

namespace {

/// Constants of mean.comp.
struct MeanOfFrames {
    bool continues;
    IR_FIELDS(continues)
};

graph::ImageRef frame_image(graph::GraphBuilder& builder, const std::string& key, const std::string& label) {
    return builder.image({.text = {.key = key,
                                   .label = label,
                                   .doc = "Of the photons of one frame.",
                                   .semantic = Semantic::irradiance},
                          .format = gl::Format::rgba32f});
}

/// Pass "mean of frames", over those in which nothing moved.
void average_frames(graph::GraphBuilder& builder, const SplatTask& task, graph::ImageRef irradiance,
                    graph::ImageRef direction) {
    builder.pass("mean of frames")
        .reads("irradiance_now", task.irradiance)
        .reads("direction_now", task.direction)
        .reads_previous("irradiance_before", irradiance)
        .reads_previous("direction_before", direction)
        .writes("irradiance", irradiance)
        .writes("direction", direction)
        .compute({{folder + "mean.comp"}}, irradiance, [](const graph::PassContext& context) {
            return MeanOfFrames{context.has_previous() &&
                                passes::stands_still(context.inputs(), passes::Watched::surfaces_and_lights)};
        });
}

void splat_on_device(graph::GraphBuilder& builder, const SplatTask& task,
                     const std::optional<graph::ImageRef>& sums) {
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
        case Splatting::one_pass:
            show_sums(builder, task, sums.value());
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
    const auto irradiance = builder.output("indirect.irradiance", {.format = gl::Format::rgba32f}),
               direction = builder.output("indirect.direction", {.format = gl::Format::rgba32f});
    task.irradiance = parameters.progressive
                          ? frame_image(builder, "splat.irradiance", "Irradiance of a frame")
                          : irradiance;
    task.direction = parameters.progressive
                         ? frame_image(builder, "splat.direction", "Sum of directions of a frame")
                         : direction;
    const bool on_host =
        builder.inputs().processor == Processor::host && parameters.splatting == Splatting::tiles;
    if (on_host)
        splat_on_host(builder, gbuffer, task);
    else
        splat_on_device(builder, task, photons.sums);
    if (parameters.progressive) average_frames(builder, task, irradiance, direction);
    return {irradiance, direction, task.irradiance, task.photons.stored, task.photons.arrivals};
}

}  // namespace ir::methods::ldm_indirect
