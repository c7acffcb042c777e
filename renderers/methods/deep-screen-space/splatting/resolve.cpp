#include "renderers/methods/deep-screen-space/splatting/host/light_on_host.h"
#include "renderers/methods/deep-screen-space/splatting/level0_light.h"
#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of resolve.comp.
struct Resolve {
    SenderConstants senders;
    VisibleLevel rules;
    int levels;
    unsigned seed;
    float highlight_share;
    IR_FIELDS(senders, rules, levels, seed, highlight_share)
};

struct Senders {
    bool glossy, exact;
    std::optional<graph::ImageRef> irradiance = {};  ///< of sources with an extent, where rays met triangles
    SenderInputs inputs = {};                        ///< only where senders are looked up again

    bool are_looked_up() const { return glossy || exact; }
};

gl::ProgramSource source_of(const VisibleSplats& visible, const Senders& senders) {
    const auto& parameters = visible.splats.parameters;
    gl::ProgramSource source{{"methods/deep-screen-space/splatting/resolve.comp"}};
    source.defines["AVERAGED"] = parameters.disc_light == DiscLight::averaged ? "1" : "0";
    source.defines["BLACK_BACKS"] = parameters.backs == Backs::black ? "1" : "0";
    source.defines["GLOSSY_SENDERS"] = senders.glossy ? "1" : "0";
    source.defines["EXACT"] = senders.exact ? "1" : "0";
    source.defines["EXTENDED"] = senders.irradiance ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(parameters.transport.materials));
    return source;
}

}  // namespace

graph::ImageRef resolve_light(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const passes::ShadowMaps& shadow, const VisibleSplats& visible,
                              graph::ImageRef distance) {
    const auto& parameters = visible.splats.parameters;
    if (builder.inputs().processor == Processor::host)
        return resolve_light_on_host(builder, shadow, visible, distance);
    Senders senders{sends_highlights(parameters), parameters.level0 == Level0::triangles};
    if (senders.exact) senders.irradiance = light_level0(builder, visible, distance);
    if (senders.are_looked_up()) senders.inputs = sender_inputs(builder, scene, shadow);
    const auto incoming = passes::bounce::declare_incoming_light(builder, visible.splats.samples);
    auto pass = builder.pass("light of the winners");
    pass.has_two_bodies();
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("Stored", visible.splats.surfels.stored)
        .reads("SurfelLights", visible.splats.surfels.lights)
        .reads(visible.gbuffer.position)
        .reads("nearest", visible.nearest)
        .reads("directions", visible.directions.directions)
        .writes("incoming", incoming);
    if (senders.exact) pass.reads("distances", distance);
    if (senders.irradiance) pass.reads("irradiance", *senders.irradiance);
    if (senders.are_looked_up()) senders.inputs.read_by(pass);
    passes::bounce::compute_by_tiles(
        pass, builder, source_of(visible, senders),
        Resolve{sender_constants(builder.inputs(), parameters), visible_level(visible.splats),
                visible.splats.hierarchy.levels, random_seed(builder.inputs(), parameters),
                highlight_share(parameters)});
    return incoming;
}

}  // namespace ir::methods::deep_screen_space
