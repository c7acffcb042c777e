#pragma once

#include "renderers/methods/deep-screen-space/parameters.h"
#include "renderers/passes/scene/hit_surfaces.h"
#include "renderers/passes/shadow/shadow_maps.h"

namespace ir::methods::deep_screen_space {

/// Constants of shaders/methods/deep-screen-space/surfels/sent.glsl.
struct SenderConstants {
    int light_count;
    bool normal_maps;
    float light_offset;
    IR_FIELDS(light_count, normal_maps, light_offset)
};
inline SenderConstants sender_constants(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return {static_cast<int>(inputs.world->lights.size()), parameters.transport.normal_maps,
            parameters.light_offset};
}

/// What passes with that file read.
struct SenderInputs {
    passes::HitSurfaces surfaces;
    graph::BufferRef lights;
    passes::ShadowMaps shadow;

    void read_by(graph::PassBuilder& pass) const {
        surfaces.read_by(pass);
        shadow.read_by(pass);
        pass.reads(lights);
    }
};
inline SenderInputs sender_inputs(graph::GraphBuilder& builder, const passes::SceneBuffers& scene,
                                  const passes::ShadowMaps& shadow) {
    return {passes::hit_surfaces(builder, scene), scene.lights, shadow};
}

}  // namespace ir::methods::deep_screen_space
