#pragma once

#include "renderers/passes/bounce/directions.h"
#include "renderers/passes/bounce/tiles.h"

namespace ir::passes::bounce {

/// What shaders/passes/bounce/receiver.glsl needs: defines, accesses and uniforms.
struct Receivers {
    SceneBuffers scene;
    GBuffer gbuffer;
    DirectionOptions options;

    void define(gl::ProgramSource& source) const;
    void declare_reads(graph::PassBuilder& pass) const;
    void set(const graph::PassContext& context, const gl::Program& program) const;
};

}  // namespace ir::passes::bounce
