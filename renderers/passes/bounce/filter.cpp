#include "renderers/passes/bounce/filter.h"

namespace ir::passes::bounce {

void Filter::define(gl::ProgramSource& source) const {
    receivers.define(source);
    source.defines["RATIO"] = parameters.estimator == Estimator::ratio ? "1" : "0";
}

void Filter::declare_reads(graph::PassBuilder& pass) const {
    receivers.declare_reads(pass);
    pass.reads("directions", directions.directions).reads("incoming", samples.incoming);
}

void Filter::set(const graph::PassContext& context, const gl::Program& program) const {
    receivers.set(context, program);
    const auto blur = options_of(parameters.blur);
    program.set("radius", blur.radius);
    program.set("plane_tolerance", blur.plane_tolerance);
    program.set("normal_power", blur.normal_power);
    program.set("samples", directions.samples);
    if (directions.options.light) program.set("material_tolerance", parameters.material_tolerance);
}

}  // namespace ir::passes::bounce
