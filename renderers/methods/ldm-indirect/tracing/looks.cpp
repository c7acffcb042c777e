#include "renderers/methods/ldm-indirect/looks.h"

#include "renderers/graph/pass_context.h"
#include "renderers/passes/ldm/host/trace_on_host.h"

namespace ir::methods::ldm_indirect {
namespace {

namespace ldm = passes::ldm;

/// Maps of one dispatch: as many as devices have uniforms for.
constexpr std::int64_t maps_together = 8;

/// Constants of look.comp.
struct Look {
    ldm::FrameConstants frames;
    unsigned first_frame, first_map, map_count, all_maps;
    float units_per_metre;
    IR_FIELDS(frames, first_frame, first_map, map_count, all_maps, units_per_metre)
};

}  // namespace

std::optional<graph::BufferRef> declare_looks(graph::GraphBuilder& builder, const Parameters& parameters) {
    if (parameters.clipping == Clipping::none || parameters.transport.paths == Transport::Paths::direct)
        return {};
    const auto& view = builder.inputs().view;
    constexpr auto side = static_cast<int>(look_tile);
    const auto tiles = static_cast<std::uint64_t>((view.width + side - 1) / side) *
                       static_cast<std::uint64_t>((view.height + side - 1) / side);
    return builder.buffer({.text = {.key = "indirect.looks",
                                    .label = "Looks of pixels",
                                    .doc = "How far each pixel sees along the direction of each map: four "
                                           "pixels to a word, by tile of 8 x 8 pixels, then by map; 16 "
                                           "steps to an octave."},
                           .fields = {{"looks", graph::FieldType::u32}},
                           .elements = tiles * static_cast<std::uint64_t>(parameters.maps.directions) *
                                       (look_tile * look_tile / 4)});
}

void look_from_pixels(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                      const ldm::MapsPointer& maps, int batch, graph::BufferRef looks) {
    auto pass = builder.pass("look from pixels" + maps->batch_name(batch));
    ldm::reads_maps(pass, *maps);
    if (ldm::has_host_body(maps->options)) pass.has_two_bodies();
    pass.reads(gbuffer.position, gbuffer.geometric_normal).writes("Looks", looks);
    const auto run = [=, position = gbuffer.position](graph::PassContext& context, graph::Slice slice) {
        gl::ProgramSource source{{"methods/ldm-indirect/tracing/look.comp"}};
        source.defines = ldm::defines_of(context, *maps);
        const auto& program = context.use(source);
        const auto shape = context.shape(position);
        const auto end = std::min<std::int64_t>(slice.end * maps_together, maps->batch_maps(batch));
        for (auto first = slice.begin * maps_together; first < end; first += maps_together) {
            const auto count = std::min(maps_together, end - first);
            const auto frame = maps->first_map(batch) + first;
            program.set(Look{.frames = ldm::frame_constants(*maps, frame, count),
                             .first_frame = static_cast<unsigned>(frame),
                             .first_map = static_cast<unsigned>(first),
                             .map_count = static_cast<unsigned>(count),
                             .all_maps = static_cast<unsigned>(maps->layout.maps),
                             .units_per_metre = units_per_metre(*context.inputs().world)});
            program.dispatch((shape.width + 3) / 4, shape.height);
            context.barrier();
        }
    };
    pass.execute_sliced((maps->batch_maps(batch) + maps_together - 1) / maps_together, run, 1);
}

}  // namespace ir::methods::ldm_indirect
