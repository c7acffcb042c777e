#include "renderers/passes/bounce/filter.h"

namespace ir::passes::bounce {

void Filter::define(gl::ProgramSource& source) const {
    receivers.define(source);
    source.defines["KERNELS"] = kernels.index >= 0 ? "1" : "0";
    source.defines["RATIO"] = parameters.estimator == Estimator::ratio ? "1" : "0";
}

void Filter::declare_reads(graph::PassBuilder& pass) const {
    receivers.declare_reads(pass);
    pass.reads("directions", directions.directions).reads("incoming", samples.incoming);
    if (kernels.index >= 0) pass.reads("kernels", kernels);
}

FilterConstants Filter::constants(const graph::FrameInputs& inputs) const {
    const auto& blur = parameters.blur;
    return {.receivers = receivers.constants(inputs),
            .radius = blur.used_radius(),
            .samples = directions.samples,
            .plane_tolerance = blur.plane_tolerance,
            .normal_power = blur.normal_power,
            .material_tolerance = parameters.material_tolerance,
            .balance = parameters.balance};
}

}  // namespace ir::passes::bounce
