#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/methods/deep-screen-space/surfels/senders.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::methods::deep_screen_space {
namespace {

/// Constants of resolve.comp.
struct Resolve {
    SenderConstants senders;
    VisibleLevel rules;
    int levels, first_sample;
    unsigned seed;
    float highlight_share;
    IR_FIELDS(senders, rules, levels, first_sample, seed, highlight_share)
};

struct Senders {
    bool glossy, exact;
    SenderInputs inputs = {};  ///< only where senders are looked up again

    bool are_looked_up() const { return glossy || exact; }
};

gl::ProgramSource source_of(const VisibleSplats& visible, const Senders& senders) {
    const auto& parameters = visible.splats.parameters;
    gl::ProgramSource source{{"methods/deep-screen-space/splatting/resolve.comp"}};
    source.defines["AVERAGED"] = parameters.disc_light == DiscLight::averaged ? "1" : "0";
    source.defines["BLACK_BACKS"] = parameters.backs == Backs::black ? "1" : "0";
    source.defines["GLOSSY_SENDERS"] = senders.glossy ? "1" : "0";
    source.defines["EXACT"] = senders.exact ? "1" : "0";
    source.defines["EXTENDED"] = visible.source_light.index >= 0 ? "1" : "0";
    source.defines["GLASS"] = visible.splats.open_glass ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(parameters.transport.materials));
    return source;
}

}  // namespace

void resolve_light(graph::GraphBuilder& builder, const VisibleSplats& visible, const std::string& batch) {
    const auto& parameters = visible.splats.parameters;
    if (builder.inputs().processor == Processor::host) {
        resolve_light_on_host(builder, visible, batch);
        return;
    }
    Senders senders{sends_highlights(parameters), parameters.level0 == Level0::triangles};
    if (visible.source_light.index >= 0) sample_winners_sources(builder, visible, batch);
    if (senders.are_looked_up()) senders.inputs = sender_inputs(builder, visible.scene, visible.shadow);
    auto pass = builder.pass("light of the winners" + batch);
    pass.has_two_bodies();
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("Stored", visible.splats.surfels.stored)
        .reads("SurfelLights", visible.splats.surfels.lights)
        .reads(visible.gbuffer.position)
        .reads("nearest", visible.nearest)
        .reads("directions", visible.directions.directions)
        .writes("incoming", visible.samples.incoming);
    if (senders.exact) pass.reads("distances", visible.samples.distance);
    if (visible.source_light.index >= 0) pass.reads("source_light", visible.source_light);
    if (senders.are_looked_up())
        senders.inputs.read_by(pass);
    else if (visible.splats.open_glass)
        read_glass(pass, visible);
    passes::bounce::compute_by_tiles(
        pass, builder, source_of(visible, senders),
        Resolve{sender_constants(builder.inputs(), parameters), visible_level(visible.splats),
                visible.splats.hierarchy.levels, visible.splats.first_sample,
                random_seed(builder.inputs(), parameters), highlight_share(parameters)});
}

}  // namespace ir::methods::deep_screen_space
