#include "renderers/passes/bounce/receiver.h"

namespace ir::passes::bounce {

void Receivers::define(gl::ProgramSource& source) const {
    source.defines["LIGHT"] = options.light ? "1" : "0";
    source.defines["MATERIALS"] = std::to_string(static_cast<int>(options.materials));
}

void Receivers::declare_reads(graph::PassBuilder& pass) const {
    pass.reads(gbuffer.position, gbuffer.normal, gbuffer.geometric_normal);
    if (options.light) pass.reads(gbuffer.albedo, gbuffer.material, scene.materials);
}

ReceiverConstants Receivers::constants(const graph::FrameInputs& inputs) const {
    return {viewer(inputs.view), options.parameters.min_roughness};
}

}  // namespace ir::passes::bounce
