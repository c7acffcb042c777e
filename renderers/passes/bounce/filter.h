#pragma once

#include "renderers/passes/bounce/receiver.h"
#include "renderers/passes/bounce/reconstruction.h"

namespace ir::passes::bounce {

/// Constants of shaders/passes/bounce/filter.glsl.
struct FilterConstants {
    ReceiverConstants receivers;
    int radius, samples;
    float plane_tolerance, normal_power, material_tolerance, balance;
    IR_FIELDS(receivers, radius, samples, plane_tolerance, normal_power, material_tolerance, balance)
};

/// Samples that are added up at a time: layers of the stacks, and whether sums begin and end with them.
struct SampleGroup {
    int first_layer = 0, samples = 0;
    bool begins = true, ends = true;
};

/// What shaders/passes/bounce/filter.glsl needs: defines, accesses and constants.
struct Filter {
    Receivers receivers;
    Directions directions;
    Samples samples;
    ReconstructionParameters parameters;
    graph::ImageRef kernels = {};

    void define(gl::ProgramSource& source) const;
    void declare_reads(graph::PassBuilder& pass) const;
    FilterConstants constants(const graph::FrameInputs& inputs) const;
};
inline Filter filter_of(const Reconstruction& r) {
    return {{r.scene, r.gbuffer, r.directions.options}, r.directions, r.samples, r.parameters, r.kernels};
}

}  // namespace ir::passes::bounce
