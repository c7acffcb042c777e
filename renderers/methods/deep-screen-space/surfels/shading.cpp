#include "renderers/methods/deep-screen-space/surfels/shading.h"

#include "renderers/methods/deep-screen-space/surfels/packing.h"
#include "renderers/passes/scene/hit_surfaces.h"

namespace ir::methods::deep_screen_space {

void shade(graph::GraphBuilder& builder, const passes::SceneBuffers& scene, const passes::ShadowMaps& shadow,
           const Surfels& surfels, const Parameters& parameters) {
    const auto surfaces = passes::hit_surfaces(builder, scene);
    const auto& transport = parameters.transport;
    gl::ProgramSource source{{"methods/deep-screen-space/surfels/shade.comp"}};
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(transport.materials));
    // light that an emitter sends to a surface is direct light of that surface
    source.defines["EMITS"] = transport.paths == Transport::Paths::full ? "1" : "0";
    auto pass = builder.pass("shade surfels");
    surfaces.read_by(pass);
    pass.reads(scene.lights, shadow.views, shadow.maps)
        .writes("Surfels", surfels.records)
        .counts("SurfelCount", surfels.count)
        .execute_sliced(
            packing_parts,
            [=, normal_maps = transport.normal_maps](graph::PassContext& context, graph::Slice slice) {
                const auto& program = context.use(source);
                program.set("light_count", static_cast<int>(context.inputs().world->lights.size()));
                program.set("normal_maps", normal_maps ? 1 : 0);
                program.set("capacity", static_cast<unsigned>(context.capacity(surfels.records)));
                dispatch_parts(program, context.capacity(surfels.records), slice);
            },
            1);
}

}  // namespace ir::methods::deep_screen_space
