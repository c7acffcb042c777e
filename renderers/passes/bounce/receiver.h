#pragma once

#include "renderers/passes/bounce/directions.h"
#include "renderers/passes/bounce/tiles.h"
#include "renderers/passes/gbuffer/pixel_rays.h"

namespace ir::passes::bounce {

/// Constants of shaders/passes/bounce/receiver.glsl, with light or without.
struct ReceiverConstants {
    Viewer viewer;
    float min_roughness;
    IR_FIELDS(viewer, min_roughness)
};

/// What shaders/passes/bounce/receiver.glsl needs: defines, accesses and constants.
struct Receivers {
    SceneBuffers scene;
    GBuffer gbuffer;
    DirectionOptions options;

    void define(gl::ProgramSource& source) const;
    void declare_reads(graph::PassBuilder& pass) const;
    ReceiverConstants constants(const graph::FrameInputs& inputs) const;
};

}  // namespace ir::passes::bounce
