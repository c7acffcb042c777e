#pragma once

#include "renderers/passes/bounce/receiver.h"
#include "renderers/passes/bounce/reconstruction.h"

namespace ir::passes::bounce {

/// What shaders/passes/bounce/filter.glsl needs.
struct Filter {
    Receivers receivers;
    Directions directions;
    Samples samples;
    ReconstructionParameters parameters;

    void define(gl::ProgramSource& source) const;
    void declare_reads(graph::PassBuilder& pass) const;
    void set(const graph::PassContext& context, const gl::Program& program) const;
};

}  // namespace ir::passes::bounce
