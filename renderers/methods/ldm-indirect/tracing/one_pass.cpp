#include "renderers/methods/ldm-indirect/tracing/one_pass.h"

#include <algorithm>

#include "renderers/gl/dispatch_items.h"
#include "renderers/methods/ldm-indirect/splatting/stored.h"
#include "renderers/methods/ldm-indirect/tracing/landing.h"
#include "shaders/methods/ldm-indirect/tracing/trace_and_splat.comp.h"

namespace ir::methods::ldm_indirect {
namespace {

constexpr std::int64_t primaries_at_once = 32768;

/// Constants of trace_and_splat.comp beside LandingConstants and Outlines.
struct TraceAndSplat {
    unsigned first_frame, first_map, maps_together;
    gl::Items items;
    IR_FIELDS(first_frame, first_map, maps_together, items)
};

}  // namespace

std::string needs_storing(const Parameters& parameters) {
    if (ray_tracer(parameters)) return "another tracer than the maps";
    if (parameters.transport.paths == Transport::Paths::direct) return "paths=direct";
    if (parameters.transport.paths == Transport::Paths::full && parameters.direct == DirectBy::photons)
        return "direct=photons";
    return {};
}

void begin_one_pass(graph::GraphBuilder& builder, Photons& photons, const Parameters& parameters) {
    photons.sums = declare_sums(builder);
    photons.arrivals = upload_arrivals(builder, parameters);
}

void trace_and_splat(graph::GraphBuilder& builder, const passes::GBuffer& gbuffer,
                     const passes::ldm::MapsPointer& maps, int batch, const Primaries& primaries,
                     const Photons& photons, const Parameters& parameters) {
    const auto sums = photons.sums.value();
    auto pass = builder.pass("trace and splat photons" + maps->batch_name(batch));
    passes::ldm::reads_maps(pass, *maps);
    const StoredPhotons as_stored{{}, *photons.arrivals, parameters, {}, photons.looks};
    reads_looks(pass, as_stored);
    pass.reads("Primaries", primaries.records)
        .reads("Arrivals", as_stored.arrivals)
        .reads(gbuffer.position, gbuffer.geometric_normal)
        .writes("sums", sums);
    const auto run = [=, landed = landing_constants(builder.inputs(), parameters)](
                         graph::PassContext& context, graph::Slice slice) {
        if (slice.first && batch == 0) context.clear(sums);
        gl::ProgramSource source{{"methods/ldm-indirect/tracing/trace_and_splat.comp"}};
        source.defines = passes::ldm::defines_of(context, *maps);
        source.defines["NOTHING_STORED"] = "1";
        define_clipped(source, as_stored);
        add_by_atomics(context, source, sums);
        const auto& program = context.use(source);
        set_units(context, program, as_stored);
        program.set(landed);
        program.set(outlines(context.inputs(), as_stored));
        constexpr std::int64_t lanes = one_pass_lanes;
        const auto batch_maps = maps->batch_maps(batch);
        for (std::int64_t map = 0; map < batch_maps; map += lanes)
            for (auto first = slice.begin; first < slice.end; first += primaries_at_once) {
                const auto end = std::min(slice.end, first + primaries_at_once);
                program.set(
                    TraceAndSplat{.first_frame = static_cast<unsigned>(maps->first_map(batch) + map),
                                  .first_map = static_cast<unsigned>(map),
                                  .maps_together = static_cast<unsigned>(std::min(lanes, batch_maps - map)),
                                  .items = {static_cast<unsigned>(first), static_cast<unsigned>(end)}});
                program.dispatch((end - first) * lanes);
            }
    };
    pass.execute_sliced(static_cast<std::int64_t>(primaries.count()), run, 16);
}

}  // namespace ir::methods::ldm_indirect
