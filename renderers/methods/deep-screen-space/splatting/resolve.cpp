#include "renderers/methods/deep-screen-space/splatting/visible.h"
#include "renderers/passes/bounce/tiles.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::deep_screen_space {
namespace {

struct Senders {
    passes::SceneBuffers scene;
    passes::ShadowMaps shadow;
    passes::HitSurfaces surfaces;  ///< only where senders are looked up again
    bool glossy, exact;

    bool are_looked_up() const { return glossy || exact; }
};

gl::ProgramSource source_of(const VisibleSplats& visible, const Senders& senders) {
    const auto& parameters = visible.splats.parameters;
    gl::ProgramSource source{{"methods/deep-screen-space/splatting/resolve.comp"}};
    source.defines["BLACK_BACKS"] = parameters.backs == Backs::black ? "1" : "0";
    source.defines["GLOSSY_SENDERS"] = senders.glossy ? "1" : "0";
    source.defines["EXACT"] = senders.exact ? "1" : "0";
    source.defines["EMITS"] = parameters.transport.paths == Transport::Paths::full ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(parameters.transport.materials));
    return source;
}

/// Constants of resolve_glossy.glsl.
struct ResolveGlossy {
    int light_count;
    bool normal_maps;
    float light_offset;
    IR_FIELDS(light_count, normal_maps, light_offset)
};

}  // namespace

graph::ImageRef resolve_light(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                              const passes::ShadowMaps& shadow, const VisibleSplats& visible,
                              graph::ImageRef distance) {
    const auto& parameters = visible.splats.parameters;
    const bool glossy =
        parameters.glossy_senders && parameters.transport.materials != Transport::Materials::lambert;
    Senders senders{scene, shadow, {}, glossy, parameters.level0 == Level0::triangles};
    if (senders.are_looked_up()) senders.surfaces = passes::hit_surfaces(builder, scene);
    const auto incoming = passes::bounce::declare_incoming_light(builder, visible.splats.samples);
    auto pass = builder.pass("light of the winners");
    pass.reads("Surfels", visible.splats.surfels.records)
        .reads("SurfelLights", visible.splats.surfels.lights)
        .reads("nearest", visible.nearest)
        .reads("directions", visible.directions.directions)
        .writes("incoming", incoming);
    if (senders.exact) pass.reads(visible.gbuffer.position).reads("distances", distance);
    if (senders.are_looked_up()) {
        pass.reads(scene.lights, shadow.views, shadow.maps);
        senders.surfaces.read_by(pass);
    }
    passes::bounce::compute_by_tiles(
        pass, builder, source_of(visible, senders),
        ResolveGlossy{static_cast<int>(builder.inputs().world->lights.size()),
                      parameters.transport.normal_maps, parameters.light_offset});
    return incoming;
}

}  // namespace ir::methods::deep_screen_space
