#include "renderers/methods/deep-screen-space/surfels/steps.h"

#include "renderers/methods/deep-screen-space/surfels/senders.h"

namespace ir::methods::deep_screen_space {

graph::BufferRef shade(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                       const passes::ShadowMaps& shadow, const Surfels& surfels,
                       const Parameters& parameters) {
    const auto room = builder.buffers().at(static_cast<std::size_t>(surfels.records.index)).elements;
    const auto lights = growing(builder,
                                {.text = {.key = "surfels.lights",
                                          .label = "Light of surfels, as passes read it",
                                          .doc = "What the surfels of \"surfels.records\" send.",
                                          .semantic = Semantic::radiance,
                                          .unit = "W/(m² sr)"},
                                 .fields = record_fields<SurfelLight>()},
                                {.key = "surfels.lit", .label = "Surfels that are lit"}, room);
    const auto irradiance = sample_sources(builder, surfels, parameters);
    if (builder.inputs().processor == Processor::host) {
        shade_on_host(builder, shadow, surfels, irradiance, lights, parameters);
        return lights.buffer;
    }
    gl::ProgramSource source{{"methods/deep-screen-space/surfels/shade.comp"}};
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(parameters.transport.materials));
    source.defines["EXTENDED"] = irradiance ? "1" : "0";
    const auto senders = sender_inputs(builder, scene, shadow);
    auto pass = builder.pass("shade surfels");
    pass.has_two_bodies();
    if (irradiance) pass.reads("SurfelIrradiance", *irradiance);
    senders.read_by(pass);
    pass.reads("Surfels", surfels.records)
        .reads("Stored", surfels.stored)
        .writes("SurfelLights", lights.buffer)
        .counts("LitCount", lights.count)
        .execute_sliced(
            packing_parts,
            [=](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use(source);
                const auto capacity = context.capacity(surfels.records);
                program.set(sender_constants(context.inputs(), parameters));
                dispatch_parts(program, capacity, slice);
            },
            1);
    return lights.buffer;
}

}  // namespace ir::methods::deep_screen_space
