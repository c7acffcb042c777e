#include "renderers/methods/photon-mapping/parameters.h"

#include "renderers/passes/scene/progressive.h"

namespace ir::methods::photon_mapping {

ParameterTable<Parameters> parameter_table() {
    ParameterTable<Parameters> table;
    add_emission_parameters(table);
    add_tracing_parameters(table);
    add_splatting_parameters(table);
    add_filtering_parameters(table);
    return table;
}

int texels(Resolution resolution) {
    return 64 << static_cast<int>(resolution);
}

passes::Tracer tracer_of(const graph::FrameInputs& inputs, const Parameters& parameters) {
    if (parameters.tracer == Tracer::cube) return passes::Tracer::cube;
    const bool on_host = parameters.tracer == Tracer::automatic ? inputs.processor == Processor::host
                                                                : parameters.tracer == Tracer::embree;
    return on_host ? passes::Tracer::embree : passes::Tracer::compute;
}

std::uint64_t photon_seed(const graph::FrameInputs& inputs, const Parameters& parameters) {
    return parameters.renews_photons() ? passes::frame_seed(inputs) : inputs.seed;
}

}  // namespace ir::methods::photon_mapping
